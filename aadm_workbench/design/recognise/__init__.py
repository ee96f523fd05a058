"""Columns, sleeves and bars among the bodies of a model of any kind."""
