"""Machine elements: beams, shafts, motors, materials."""
