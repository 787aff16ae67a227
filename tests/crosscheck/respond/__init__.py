"""Two witnesses for a free-standing block that share nothing with the program: events with DOP853, and time stepping."""
