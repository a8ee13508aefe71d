"""Functions that several readers use: arrays, tables of numbers, heights at positions."""
