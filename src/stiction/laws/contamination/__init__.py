"""junctions that differ; none: without"""
