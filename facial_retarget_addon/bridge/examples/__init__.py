"""Example expressions: made, sculpted, mirrored, checked."""
