"""The catalogue of machines. A new machine is a file here and a line below."""

from ilmek.machines.beat_up import MACHINE as BEAT_UP
from ilmek.machines.machine import Machine
from ilmek.machines.weaver import MACHINE as WEAVER

MACHINES: dict[str, Machine] = {machine.name: machine for machine in (BEAT_UP, WEAVER)}
"""Every machine by its name, in the order of the catalogue."""
