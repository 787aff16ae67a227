"""Imports of the fork server: the modules of the commands."""

from seisblock.app.jobs import preload

preload()
