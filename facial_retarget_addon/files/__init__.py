"""Readers and writers. No Blender."""
