"""The block that explains what fell: outcomes of many shakings, read back as the body's parameters."""
