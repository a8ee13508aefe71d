"""capillary menisci between asperities ("none" leaves them out)"""
