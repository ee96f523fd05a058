"""As-designed points of the open document."""
