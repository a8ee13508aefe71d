"""growth of the interface strength with the hold time ("none" leaves it out)"""
