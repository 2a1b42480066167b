"""ilmek: carpet in, loom out.

Designs, proves and runs machines that make carpets. The names below are stable and documented in
`docs/reference/python.md`: verbs over records, lengths in metres and angles in radians. Each is imported when it is
first used, so that `import ilmek` costs nothing. The layers are listed in `docs/explanation/architecture.md`.
"""

from typing import TYPE_CHECKING

from ilmek.lazy import lazy_names

__version__ = "0.2.0"

PUBLIC = {
    # mechanisms
    "Mechanism": "ilmek.linkage.model",
    "Body": "ilmek.linkage.model",
    "Pin": "ilmek.linkage.model",
    "Slide": "ilmek.linkage.model",
    "Rotation": "ilmek.linkage.model",
    "Displacement": "ilmek.linkage.model",
    "Coupling": "ilmek.linkage.model",
    "four_bar": "ilmek.api.mechanisms",
    "slider_crank": "ilmek.api.mechanisms",
    "read_mechanism": "ilmek.api.mechanisms",
    "write_mechanism": "ilmek.api.mechanisms",
    "solve": "ilmek.api.mechanisms",
    "Motion": "ilmek.linkage.motion",
    # forces
    "Inertia": "ilmek.dynamics.inertia",
    "bar": "ilmek.api.masses",
    "bar_mass": "ilmek.api.masses",
    "point_mass": "ilmek.api.masses",
    "combined": "ilmek.api.masses",
    "Load": "ilmek.dynamics.loads",
    "Gravity": "ilmek.dynamics.loads",
    "PointForce": "ilmek.dynamics.loads",
    "Torque": "ilmek.dynamics.loads",
    "Spring": "ilmek.dynamics.springs",
    "inverse_dynamics": "ilmek.api.mechanisms",
    "Forces": "ilmek.dynamics.inverse",
    "simulate": "ilmek.api.mechanisms",
    "OwnMachine": "ilmek.dynamics.own_machine",
    "run_machine": "ilmek.api.machine_runs",
    "ForwardRun": "ilmek.dynamics.forward_run",
    # cams
    "motion_law": "ilmek.api.cams",
    "rise": "ilmek.api.cams",
    "dwell": "ilmek.api.cams",
    "fall": "ilmek.api.cams",
    "cam_programme": "ilmek.api.cams",
    "CamProgramme": "ilmek.cams.programme",
    "plate_cam": "ilmek.api.cams",
    "PlateCam": "ilmek.cams.plate",
    "largest_pressure_angle": "ilmek.api.cams",
    # synthesis
    "path_four_bars": "ilmek.api.four_bars",
    "motion_four_bars": "ilmek.api.four_bars",
    "function_four_bars": "ilmek.api.four_bars",
    "crank_rocker": "ilmek.api.four_bars",
    # carpets
    "read_picture": "ilmek.api.carpets",
    "read_yarns": "ilmek.api.carpets",
    "make_chart": "ilmek.api.carpets",
    "Chart": "ilmek.carpet.chart",
    "write_chart": "ilmek.api.carpets",
    "read_chart": "ilmek.api.carpets",
    "weave": "ilmek.api.carpets",
    # machines
    "list_machines": "ilmek.api.designs",
    "design": "ilmek.api.designs",
    "Report": "ilmek.report",
    "reproduce": "ilmek.api.designs",
    # for all of them
    "units": "ilmek.units",
    "Progress": "ilmek.progress",
    "Cancelled": "ilmek.progress",
    "IlmekError": "ilmek.errors",
}
"""Each public name and the module that it comes from."""

__all__ = list(PUBLIC)
__getattr__, __dir__ = lazy_names(__name__, PUBLIC)

if TYPE_CHECKING:
    from ilmek import units as units
    from ilmek.api.cams import cam_programme as cam_programme
    from ilmek.api.cams import dwell as dwell
    from ilmek.api.cams import fall as fall
    from ilmek.api.cams import largest_pressure_angle as largest_pressure_angle
    from ilmek.api.cams import motion_law as motion_law
    from ilmek.api.cams import plate_cam as plate_cam
    from ilmek.api.cams import rise as rise
    from ilmek.api.carpets import make_chart as make_chart
    from ilmek.api.carpets import read_chart as read_chart
    from ilmek.api.carpets import read_picture as read_picture
    from ilmek.api.carpets import read_yarns as read_yarns
    from ilmek.api.carpets import weave as weave
    from ilmek.api.carpets import write_chart as write_chart
    from ilmek.api.designs import design as design
    from ilmek.api.designs import list_machines as list_machines
    from ilmek.api.designs import reproduce as reproduce
    from ilmek.api.four_bars import crank_rocker as crank_rocker
    from ilmek.api.four_bars import function_four_bars as function_four_bars
    from ilmek.api.four_bars import motion_four_bars as motion_four_bars
    from ilmek.api.four_bars import path_four_bars as path_four_bars
    from ilmek.api.machine_runs import run_machine as run_machine
    from ilmek.api.masses import bar as bar
    from ilmek.api.masses import bar_mass as bar_mass
    from ilmek.api.masses import combined as combined
    from ilmek.api.masses import point_mass as point_mass
    from ilmek.api.mechanisms import four_bar as four_bar
    from ilmek.api.mechanisms import inverse_dynamics as inverse_dynamics
    from ilmek.api.mechanisms import read_mechanism as read_mechanism
    from ilmek.api.mechanisms import simulate as simulate
    from ilmek.api.mechanisms import slider_crank as slider_crank
    from ilmek.api.mechanisms import solve as solve
    from ilmek.api.mechanisms import write_mechanism as write_mechanism
    from ilmek.cams.plate import PlateCam as PlateCam
    from ilmek.cams.programme import CamProgramme as CamProgramme
    from ilmek.carpet.chart import Chart as Chart
    from ilmek.dynamics.forward_run import ForwardRun as ForwardRun
    from ilmek.dynamics.inertia import Inertia as Inertia
    from ilmek.dynamics.inverse import Forces as Forces
    from ilmek.dynamics.loads import Gravity as Gravity
    from ilmek.dynamics.loads import Load as Load
    from ilmek.dynamics.loads import PointForce as PointForce
    from ilmek.dynamics.loads import Torque as Torque
    from ilmek.dynamics.own_machine import OwnMachine as OwnMachine
    from ilmek.dynamics.springs import Spring as Spring
    from ilmek.errors import IlmekError as IlmekError
    from ilmek.linkage.model import Body as Body
    from ilmek.linkage.model import Coupling as Coupling
    from ilmek.linkage.model import Displacement as Displacement
    from ilmek.linkage.model import Mechanism as Mechanism
    from ilmek.linkage.model import Pin as Pin
    from ilmek.linkage.model import Rotation as Rotation
    from ilmek.linkage.model import Slide as Slide
    from ilmek.linkage.motion import Motion as Motion
    from ilmek.progress import Cancelled as Cancelled
    from ilmek.progress import Progress as Progress
    from ilmek.report import Report as Report
