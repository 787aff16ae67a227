"""One model per file: from a motion and a body to a response."""
