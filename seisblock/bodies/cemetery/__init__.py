"""Cemeteries: gravestones and their tables."""
