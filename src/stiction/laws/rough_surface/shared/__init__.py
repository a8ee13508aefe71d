"""Functions that theories of rough surfaces share."""
