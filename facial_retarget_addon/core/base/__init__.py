"""The base mesh that feature points span on both faces."""
