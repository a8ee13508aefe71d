"""What formats of files have in common: arrays, numbers in text, heights that come with their positions."""
