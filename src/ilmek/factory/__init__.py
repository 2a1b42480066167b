"""The factory: several carpets on looms that exist, planned together."""
