"""Cams: motion laws, programmes of rises, falls and dwells, profiles and their limits."""
