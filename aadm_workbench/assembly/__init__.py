"""From assembly points to a verdict: match, fit, inspect, try the assembly, decide.

Pure functions: no file is touched (but the tolerance profiles, in :mod:`.tolerances`), nothing is printed,
no clock is read, and every random generator is an argument.
"""
