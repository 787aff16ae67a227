"""Figures of results, one module per command."""
