"""A block on corner springs: modes, harmonic uplift, response to a record."""
