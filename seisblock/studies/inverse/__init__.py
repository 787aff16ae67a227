"""Shaking read back from what it did."""
