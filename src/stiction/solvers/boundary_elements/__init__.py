"""Contact of a height map, solved point by point by boundary elements; the reference for asperity models."""
