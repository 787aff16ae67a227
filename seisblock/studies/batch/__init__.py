"""Batches of records and bodies with one result table."""
