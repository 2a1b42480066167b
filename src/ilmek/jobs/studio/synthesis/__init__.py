"""Linkages for a task."""
