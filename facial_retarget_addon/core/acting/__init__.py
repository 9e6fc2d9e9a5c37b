"""Faces that feature points move: weights, lids and eyes, FAPs in and frames out."""
