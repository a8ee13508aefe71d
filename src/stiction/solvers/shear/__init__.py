"""Solve the tangential contact of height maps: which points stick, which slip, and the force at which all slip."""
