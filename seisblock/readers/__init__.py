"""How a record is read."""
