"""Models of the bodies of a report."""
