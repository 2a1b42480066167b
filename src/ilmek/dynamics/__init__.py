"""Masses, loads and the forces that a motion needs.

The names below are public; each is imported when it is first used. A function that has the name of its module is
imported from that module.
"""

from typing import TYPE_CHECKING

from ilmek.lazy import lazy_names

PUBLIC = {
    "cyclic_torque": "ilmek.dynamics.flywheel",
    "at_angle": "ilmek.dynamics.forward",
    "at_rest": "ilmek.dynamics.forward",
    "at_speed": "ilmek.dynamics.forward",
    "ForwardRun": "ilmek.dynamics.forward_run",
    "ForwardState": "ilmek.dynamics.forward_run",
    "Inertia": "ilmek.dynamics.inertia",
    "bar": "ilmek.dynamics.inertia",
    "bar_mass": "ilmek.dynamics.inertia",
    "combined": "ilmek.dynamics.inertia",
    "point_mass": "ilmek.dynamics.inertia",
    "Forces": "ilmek.dynamics.inverse",
    "PinFriction": "ilmek.dynamics.joint_friction",
    "SlideFriction": "ilmek.dynamics.joint_friction",
    "Gravity": "ilmek.dynamics.loads",
    "Load": "ilmek.dynamics.loads",
    "PointForce": "ilmek.dynamics.loads",
    "Torque": "ilmek.dynamics.loads",
    "ReducedMechanism": "ilmek.dynamics.reduced",
    "reduce": "ilmek.dynamics.reduced",
    "disc": "ilmek.dynamics.shapes",
    "plate": "ilmek.dynamics.shapes",
    "ring": "ilmek.dynamics.shapes",
    "Spring": "ilmek.dynamics.springs",
    "TorsionSpring": "ilmek.dynamics.springs",
}

__all__ = list(PUBLIC)
__getattr__, __dir__ = lazy_names(__name__, PUBLIC)

if TYPE_CHECKING:
    from ilmek.dynamics.flywheel import cyclic_torque as cyclic_torque
    from ilmek.dynamics.forward import at_angle as at_angle
    from ilmek.dynamics.forward import at_rest as at_rest
    from ilmek.dynamics.forward import at_speed as at_speed
    from ilmek.dynamics.forward_run import ForwardRun as ForwardRun
    from ilmek.dynamics.forward_run import ForwardState as ForwardState
    from ilmek.dynamics.inertia import Inertia as Inertia
    from ilmek.dynamics.inertia import bar as bar
    from ilmek.dynamics.inertia import bar_mass as bar_mass
    from ilmek.dynamics.inertia import combined as combined
    from ilmek.dynamics.inertia import point_mass as point_mass
    from ilmek.dynamics.inverse import Forces as Forces
    from ilmek.dynamics.joint_friction import PinFriction as PinFriction
    from ilmek.dynamics.joint_friction import SlideFriction as SlideFriction
    from ilmek.dynamics.loads import Gravity as Gravity
    from ilmek.dynamics.loads import Load as Load
    from ilmek.dynamics.loads import PointForce as PointForce
    from ilmek.dynamics.loads import Torque as Torque
    from ilmek.dynamics.reduced import ReducedMechanism as ReducedMechanism
    from ilmek.dynamics.reduced import reduce as reduce
    from ilmek.dynamics.shapes import disc as disc
    from ilmek.dynamics.shapes import plate as plate
    from ilmek.dynamics.shapes import ring as ring
    from ilmek.dynamics.springs import Spring as Spring
    from ilmek.dynamics.springs import TorsionSpring as TorsionSpring
