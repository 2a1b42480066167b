"""Papers of a machine as PDF."""
