"""MPEG-4 facial animation: its tables, its units, and its parameters turned into motion of points."""
