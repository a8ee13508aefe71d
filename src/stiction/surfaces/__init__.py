"""Measured and made surfaces: reading, preparing, statistics, asperities."""
