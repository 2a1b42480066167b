"""Pictures by a tufting machine: its programme stroke by stroke, and a twin that tufts it."""
