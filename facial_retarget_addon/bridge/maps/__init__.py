"""Normal maps: made, written, shown by materials."""
