"""Pages for people: HTML, PDF, crew pages, scan cards."""
