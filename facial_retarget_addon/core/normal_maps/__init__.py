"""Normal maps: the fine mesh of a frame as pixels on the artist's light mesh."""
