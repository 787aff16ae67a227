"""Bayesian estimation of block parameters from outcomes of shaking tests."""
