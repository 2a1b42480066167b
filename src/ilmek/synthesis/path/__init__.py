"""Path generation: four-bars whose coupler point passes through given points."""
