"""Mechanical models: the response of a body to a ground motion, one subpackage per model."""
