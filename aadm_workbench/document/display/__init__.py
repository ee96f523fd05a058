"""What objects of a document look like."""
