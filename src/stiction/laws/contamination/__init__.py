"""scatter of the strength of junctions ("none" leaves it out)"""
