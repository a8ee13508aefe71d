"""Elastic bodies that carry a film: their compliance, and a sphere pressed against them."""
