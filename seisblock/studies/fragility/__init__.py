"""Fragility curves of bodies over a suite of records: stripes, incremental dynamic analysis (IDA) and cloud analysis."""
