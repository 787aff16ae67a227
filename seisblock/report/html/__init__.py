"""HTML pages: report, map, gallery of validation cases, notebook display."""
