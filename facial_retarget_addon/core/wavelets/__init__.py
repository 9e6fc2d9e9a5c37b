"""Subdivision wavelets: a mesh of subdivision connectivity as a base and what every level adds to it."""
