"""Masses, loads and the forces that a motion needs."""
