"""Solve the contact of a height map point by point with the boundary element method.

It is the reference for asperity models.
"""
