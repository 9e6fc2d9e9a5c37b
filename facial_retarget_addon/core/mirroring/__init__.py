"""Left and right of one face: where each vertex's mirror image lies on the surface, and shapes mirrored there."""
