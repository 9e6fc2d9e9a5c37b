"""Lips and lids: where the two sides of an opening run on a face, and what keeps them closing."""
