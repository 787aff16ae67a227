"""Piles of stones: geometry, contact and checks."""
