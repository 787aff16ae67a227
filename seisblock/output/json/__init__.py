"""Types of JSON documents, entries generated from dataclasses, and the encoder."""
