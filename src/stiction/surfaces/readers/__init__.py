"""Read scan files: one module per file format, each with a constant READER."""
