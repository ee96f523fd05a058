"""Jobs of a document: the columns, scans and settings of a panel as the file that the command reads, and back."""
