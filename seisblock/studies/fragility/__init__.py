"""From records to a curve: how likely it happens at each level of an intensity measure."""
