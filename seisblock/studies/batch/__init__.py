"""Many records and many bodies: one table."""
