"""What becomes of frames in Blender: shape keys, curves of a rig, caches."""
