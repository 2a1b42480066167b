"""Plane geometry in complex numbers."""
