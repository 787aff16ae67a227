"""Overturning rates of cemeteries, and ground motion estimated from surveys of fallen stones."""
