"""Drivers: what stands behind the ports of the controller, and field buses that reach it."""
