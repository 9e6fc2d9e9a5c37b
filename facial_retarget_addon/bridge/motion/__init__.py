"""MPEG-4 motion in and out: controls, shapes, curves."""
