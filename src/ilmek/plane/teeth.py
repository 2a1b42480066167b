"""Teeth of involute gears and racks."""

from ilmek.units import deg

PRESSURE_ANGLE = 20 * deg
"""Pressure angle of the basic rack [ISO 53] [rad]."""
