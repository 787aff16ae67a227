"""Bodies: rigid blocks, two-layer blocks, piles of stones, scans and sliding bases."""
