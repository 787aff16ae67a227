"""Coulomb sliding on a level or sloping base."""
