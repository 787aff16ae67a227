"""Answers as animations."""
