"""Matter: shapes by features, parts, bodies and their joints; every view of a machine is a function of its tree."""
