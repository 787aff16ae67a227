"""From a fragility and the hazard of a site to the frequency with which it happens there."""
