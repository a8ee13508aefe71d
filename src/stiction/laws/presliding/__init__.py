"""tangential stiffness before sliding"""
