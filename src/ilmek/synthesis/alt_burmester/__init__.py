"""All four-bars for nine points of a path, or for poses and points together that determine them (Alt-Burmester)."""
