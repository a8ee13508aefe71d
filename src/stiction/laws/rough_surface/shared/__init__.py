"""What several theories of rough surfaces share."""
