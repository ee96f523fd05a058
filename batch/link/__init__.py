"""The hoisting state for machines: one file a protocol, all of them showing one snapshot, none of them a command."""
