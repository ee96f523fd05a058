"""The methods of the literature, kept as baselines: the paper's fusion method and its two peers."""
