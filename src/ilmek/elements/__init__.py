"""Machine elements: beams, shafts, bearings, springs, gears, belts, screws, motors and reducers, tubes, materials."""
