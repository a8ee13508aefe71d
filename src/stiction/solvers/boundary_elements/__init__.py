"""The contact of a map itself, solved point by point: the measure of every model of asperities."""
