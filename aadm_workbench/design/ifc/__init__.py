"""As-designed points from IFC models."""
