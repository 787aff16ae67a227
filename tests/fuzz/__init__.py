"""Fuzzing of files, bodies, cemeteries and command lines with seeded random damage."""
