"""What contradicts the design, the declaration or the camera: rules that make findings, each of one kind.

Every threshold comes from an uncertainty and from a play that is stated with its source. ``finding`` makes the
findings and says what they do to a verdict, ``rules`` holds those that look at one column by itself.
"""
