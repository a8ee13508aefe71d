"""strengthening at rest; none: without"""
