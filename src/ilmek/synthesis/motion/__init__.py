"""Four-bars for a motion: search of the families of three and four poses, with all limits inside the search."""
