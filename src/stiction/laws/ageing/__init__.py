"""ageing_rate at rest; none: without"""
