"""Provide functions that theories of rough surfaces share."""
