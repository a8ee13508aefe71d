"""Represent measured and generated rough surfaces: reading, preparation, statistics and asperities."""
