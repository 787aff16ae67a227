"""A pile of stones in three dimensions, by discrete elements."""
