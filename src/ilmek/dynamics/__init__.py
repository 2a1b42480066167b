"""Forces from motion."""
