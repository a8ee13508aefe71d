"""Compute the elastic behaviour of bodies with a film: compliance, stresses, and contact with a sphere."""
