"""A cemetery and its table."""
