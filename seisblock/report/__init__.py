"""What one sees: tables, figures, animations, documents."""
