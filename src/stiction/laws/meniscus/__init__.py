"""menisci; none: without"""
