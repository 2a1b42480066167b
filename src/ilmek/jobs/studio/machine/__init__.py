"""The form of a machine, its design, and what its parameters do."""
