"""What a camera does to a plate: learned from captures of it."""
