"""Which body the user means: options and what they build."""
