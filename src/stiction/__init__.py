"""Static friction of rough, adhesive, possibly soft-coated contacts."""
