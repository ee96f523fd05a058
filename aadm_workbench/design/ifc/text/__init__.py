"""IFC files as text: unpacked, decoded, prepared and parsed."""
