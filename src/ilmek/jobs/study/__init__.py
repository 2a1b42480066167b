"""Studies of machines and mechanisms: the order as written, what is evaluated, the run, its report."""
