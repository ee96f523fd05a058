"""From files and settings to a typed report: the one path of the command, its workers and the watch."""
