"""Figures and tables of reports as plain data."""
