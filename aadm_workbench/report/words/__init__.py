"""Words and sentences of reports, English and Chinese."""
