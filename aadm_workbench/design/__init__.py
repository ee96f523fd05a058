"""As-designed assembly points, from a model or from the text of a job."""
