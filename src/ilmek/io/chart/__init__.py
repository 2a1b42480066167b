"""Knot charts as PNG and as printed sheets (PDF)."""
