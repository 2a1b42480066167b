"""Dimensions from tasks."""
