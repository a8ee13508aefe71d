"""Functions that formats share: arrays, numbers in text, heights with positions."""
