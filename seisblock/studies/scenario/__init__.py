"""Decisions on unanchored objects: which of them fall in a scenario, and what prevents it."""
