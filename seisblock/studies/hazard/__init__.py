"""Annual frequency of a limit state from a fragility and a site hazard."""
