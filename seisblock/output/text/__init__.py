"""Tables and sentences for the terminal: number formats, line breaks, headings of records, shaking and thresholds."""
