"""Studies on scans of known truth: how exact and how fast each method is, beside what was published."""
