"""Assur groups in closed form, one file each."""
