"""Formats of files that are read, one file each, with its READER."""
