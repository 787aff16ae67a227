"""Readers: what the file says is what the solver sees."""
