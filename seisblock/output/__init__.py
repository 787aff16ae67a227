"""Toolkit of presentation, which knows no model: units and directions of display, tables, figures, animations, documents, files."""
