"""One number per record: peaks, equivalent frequencies, durations, intensities."""
