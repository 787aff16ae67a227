"""What is damaged, mistyped and misunderstood: files, bodies, cemeteries and command lines, spoilt by seeded dice."""
