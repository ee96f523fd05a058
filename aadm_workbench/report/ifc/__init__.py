"""Results into IFC models."""
