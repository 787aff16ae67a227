"""Margin, perturbation, azimuth and spectrum studies of one rocking block."""
