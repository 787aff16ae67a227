"""Tests of the languages: texts, catalogues, Japanese output."""
