"""Piles of stones: what stands on what, and how the stones press on each other."""
