"""Answers as figures, in one style."""
