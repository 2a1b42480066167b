"""Planar linkages: bodies, joints, closed-form motion."""
