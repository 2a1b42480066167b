"""Cyclograms under the hands of their user."""
