"""A mechanism of a file as a machine: its motion, forces, strength, forward run; report, figures, numbers."""
