"""Rocking and overturning of one rigid block."""
