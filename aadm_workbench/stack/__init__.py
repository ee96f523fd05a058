"""The tower: what columns that stand off their places do to beams, and to the bars of the next storey."""
