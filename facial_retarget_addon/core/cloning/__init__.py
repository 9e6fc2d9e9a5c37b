"""Facial motion cloning (Pandzic 2001): two faces in one plane, and motion in the units of each."""
