"""The job file, read and checked."""
