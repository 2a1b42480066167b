"""A loom's knot and row in motion: views from the side, from the front and from above; actuators over the angle."""
