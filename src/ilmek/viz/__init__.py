"""Figures, carpet pictures and HTML pages."""
