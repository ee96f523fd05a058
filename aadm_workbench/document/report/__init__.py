"""Reports into documents, and documents into reports."""
