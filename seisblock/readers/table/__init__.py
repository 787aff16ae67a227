"""Delimited text tables of motion: layout, headings, units, time stamps and sampling interval."""
