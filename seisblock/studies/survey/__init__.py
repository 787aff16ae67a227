"""Which share of a cemetery falls."""
