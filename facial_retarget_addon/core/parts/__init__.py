"""The parts of a head that hold no feature points, and how they follow its skin."""
