"""Scanned bodies: from a mesh to block dimensions for each azimuth."""
