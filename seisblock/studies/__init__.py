"""Studies of many runs: probability, margin, spectrum, fragility, hazard, survey, fit, map and batch."""
