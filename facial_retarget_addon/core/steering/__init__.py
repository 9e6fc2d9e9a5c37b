"""Examples, and how they steer a result."""
