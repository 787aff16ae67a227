"""The two-layer block: rocking, impact, jump, landing, rocking-sliding."""
