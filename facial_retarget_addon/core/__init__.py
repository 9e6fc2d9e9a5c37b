"""The numerical core: NumPy, SciPy and Embree. No Blender, no files, no printing, no state."""
