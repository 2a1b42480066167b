"""Design studies: sweeps, sensitivities, tolerances and optima of anything that turns values into numbers and checks."""
