"""Solve the contact of a height map point by point with the boundary element method.

The solutions are the reference by which asperity models are judged.
"""
