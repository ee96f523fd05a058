"""The second virtual camera: fringe projection whose light is path-traced by Mitsuba 3.

It shares no formula with the ray caster and its law of noise (``twin/raycast.py``, ``twin/noise.py``): what a depth
map shows at edges, in sleeves and on metal follows here from lenses, pixels, bouncing light and phase decoding.
"""
