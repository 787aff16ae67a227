"""Monte Carlo, azimuth and mode-map studies of one free-standing body with the full response."""
