"""The linkage editor."""
