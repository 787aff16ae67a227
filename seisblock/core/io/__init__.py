"""Safe file input and output: locks, checkpoints, CSV tables and protection of input files."""
