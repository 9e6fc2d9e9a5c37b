"""What was found in a result, and where it shows."""
