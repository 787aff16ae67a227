"""Text reports: tables and sentences of each command."""
