"""What IFC entities look like: placements, curves, profiles, solids."""
