"""Body models shown in a report."""
