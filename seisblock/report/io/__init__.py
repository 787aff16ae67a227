"""Output files of answers: time histories, tables and their formats."""
