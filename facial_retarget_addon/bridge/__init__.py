"""Blender data to arrays and back. Only operators and scripts import it, when they run: it loads SciPy."""
