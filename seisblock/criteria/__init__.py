"""Closed forms: each a cited formula."""
