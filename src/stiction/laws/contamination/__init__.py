"""scatter of the junction strength ("none" leaves it out)"""
