"""Bodies that were scanned: from a mesh to the arms with which they rock in every direction."""
