"""The loom's programme."""
