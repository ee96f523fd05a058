"""The outline of a foot in the scan of its face: four straight edges, and how flat the face is."""
