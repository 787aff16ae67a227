"""Tests of the languages: texts, catalogues, what is shown in Japanese."""
