"""The plate: holes like a foot's sleeves and pins like bars, for a workshop to make."""
