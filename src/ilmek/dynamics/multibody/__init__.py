"""General planar multibody systems: bodies, pins, slides and pins with clearance, integrated in time."""
