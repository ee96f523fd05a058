"""How a column swings between frames, and where it would come to rest."""
