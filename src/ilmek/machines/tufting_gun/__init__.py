"""A tufting gun on a gantry: what it needs for a carpet whose strokes are planned [`ilmek.weaving.gun`]."""
