"""What contradicts the design, the declaration or the camera: one rule a file, each makes findings of one kind.

Every threshold comes from an uncertainty and from a play that is stated with its source. ``make`` makes the findings,
``hold`` says what they do to a verdict, ``rules`` asks all rules of one column.
"""
