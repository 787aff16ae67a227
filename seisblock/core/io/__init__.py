"""Safe file input and output: atomic writes, locks, checkpoints, CSV tables and protection of input files."""
