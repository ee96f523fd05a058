"""Results as BCF topics."""
