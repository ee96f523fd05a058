"""Virtual trial assembly."""
