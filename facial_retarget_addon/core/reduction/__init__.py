"""Many frames as few shape keys and their curves."""
