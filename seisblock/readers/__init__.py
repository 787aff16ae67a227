"""Readers of strong-motion records: JMA, NIED, PEER and other formats, plain tables, and ObsPy formats."""

from seisblock.readers.read import read, read_all

__all__ = ["read", "read_all"]
