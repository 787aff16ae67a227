"""Many runs: spectra, fragility, overturning rates, inverse estimates, batches."""
