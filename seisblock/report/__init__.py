"""Output: text tables, figures, animations, HTML pages, JSON documents and export formats."""
