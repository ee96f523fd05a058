"""What the command shows: tables, progress, events."""
