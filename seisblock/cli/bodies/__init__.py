"""Command-line options of bodies and the bodies built from them."""
