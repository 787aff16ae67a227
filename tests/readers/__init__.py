"""Readers: samples equal the values in the files."""
