"""Many runs of one free-standing body: probabilities, directions, maps of what happens."""
