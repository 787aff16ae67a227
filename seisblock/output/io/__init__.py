"""Output files: time histories, tables and their formats."""
