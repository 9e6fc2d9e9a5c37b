"""Heads out of Blender: prepared copies with plain shape keys, and Blender's exporters."""
