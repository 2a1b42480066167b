"""Design studies: sweeps, sensitivities, tolerances and optima of whatever makes numbers of values."""
