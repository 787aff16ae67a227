"""Synthetic records: enveloped noise with the spectrum of a point-source earthquake model."""
