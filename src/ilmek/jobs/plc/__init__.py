"""The loom's control on a PLC: its program, the host that feeds it with rows, a simulated loom as its counterpart."""
