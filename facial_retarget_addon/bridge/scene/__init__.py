"""What is set up in the scene and its windows."""
