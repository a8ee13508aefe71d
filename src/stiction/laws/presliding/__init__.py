"""stiffness before sliding"""
