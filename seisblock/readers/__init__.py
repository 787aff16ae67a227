"""Readers of strong-motion records: JMA, NIED, PEER and other formats, plain tables, and ObsPy formats."""

from seisblock.readers.read import read, read_all
from seisblock.samples import DEFAULT_SAMPLE, REAL_SAMPLE, Sample, list_samples, sample_path

__all__ = ["DEFAULT_SAMPLE", "REAL_SAMPLE", "Sample", "list_samples", "read", "read_all", "sample_path"]
