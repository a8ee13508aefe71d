"""growth of the interface strength with the time at rest ("none" leaves it out)"""
