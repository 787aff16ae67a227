"""Stations of an earthquake: intensity measures and the response of a body or a cemetery."""
