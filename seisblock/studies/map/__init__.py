"""An earthquake's stations: what each measured, and what that did to a body or a cemetery."""
