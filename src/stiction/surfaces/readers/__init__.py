"""Readers of scan files: one module per file format, each with a record READER."""
