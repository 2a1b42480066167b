"""The catalogue of machines."""
