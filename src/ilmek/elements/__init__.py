"""Machine elements: beams, shafts, bearings, motors and reducers, materials."""
