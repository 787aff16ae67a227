"""Style, fonts, headings and time histories shared by all figures."""
