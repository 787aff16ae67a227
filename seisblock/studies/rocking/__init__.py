"""Many runs of one rocking block: margins, probabilities, spectra."""
