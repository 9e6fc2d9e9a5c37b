"""Levels of detail: subdivision, and the normal mesh that stands on it."""
