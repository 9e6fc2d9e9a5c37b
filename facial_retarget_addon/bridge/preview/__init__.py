"""The live preview, and the shape key that carries it."""
