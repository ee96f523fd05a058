"""Factors between what a robust figure says of some values and what it says of a normal law."""

TO_SIGMA = 1.4826
"""A median of absolute deviations times this is the standard deviation of a normal law: 1/Φ⁻¹(3/4)."""
OF_MEDIAN = 1.2533
"""A median of n normal values scatters by this times their standard deviation over √n: √(π/2)."""
