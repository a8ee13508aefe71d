"""Provide functions that more than one reader uses: for arrays, tables of numbers, and heights at positions."""
