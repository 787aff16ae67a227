"""Records that nobody measured: noise under an envelope, with the spectrum of an earthquake of some size, some way off."""
