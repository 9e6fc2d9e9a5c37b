"""Whole sets of shapes: choosing, halving, joining them, and taking them from one head to another."""
