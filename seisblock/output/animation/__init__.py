"""Animations of responses: GIF, MP4 and HTML."""
