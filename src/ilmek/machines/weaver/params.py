"""What may be asked of a knotting head."""

from dataclasses import dataclass

from ilmek.cams.laws import SMOOTH_LAWS
from ilmek.errors import ParameterError
from ilmek.params import Params, param
from ilmek.units import deg, format_quantity, mm, turn

LEAST_STEP = 10 * deg
"""Least angle of a step of the turn."""


PAIR = 6 * mm
"""Usual distance of the pair of warps in the opener's slots."""


@dataclass(frozen=True, slots=True)
class WeaverParams(Params):
    """What may be asked of a knotting head. Phases and strokes are choices of ours: the thesis prints none."""

    cycle: float = param(
        2.0,
        unit="s",
        at_least=1e-3,
        at_most=3600.0,
        doc="time of a knot that is asked for; longer where limits demand it",
    )
    law: str = param("modified-sine", choices=SMOOTH_LAWS, doc="law of all motions")
    prepare_end: float = param(100 * deg, unit="deg", above=0.0, below=turn, doc="cam angle at which the pile is ready")
    open_end: float = param(172 * deg, unit="deg", above=0.0, below=turn, doc="cam angle at which the warps are open")
    knot_end: float = param(250 * deg, unit="deg", above=0.0, below=turn, doc="cam angle at which the knot is made")
    press_end: float = param(345 * deg, unit="deg", above=0.0, at_most=turn, doc="cam angle at which all are back")
    relation_gap: float = param(1 * deg, unit="deg", at_least=0.0, below=turn, doc="least gap of motions in sequence")
    jaw: float = param(0.003, unit="mm", above=0.0, at_most=0.05, doc="opening of the grippers' jaws")
    pull_back: float = param(0.008, unit="mm", above=0.0, at_most=0.1, doc="side grippers back, to free the handler")
    opening: float = param(0.020, unit="mm", above=0.0, at_most=0.3, doc="side grippers and opener forward")
    crossing: float = param(0.020, unit="mm", above=0.0, at_most=0.3, doc="side grippers along the screw")
    crossing_turn: float = param(180 * deg, unit="deg", above=0.0, at_most=turn, doc="what the screw turns them by")
    centre_stroke: float = param(0.025, unit="mm", above=0.0, at_most=0.3, doc="centre gripper forward")
    sley_stroke: float = param(0.025, unit="mm", above=0.0, at_most=0.3, doc="sley down")
    knot_yarn: float = param(0.045, unit="mm", above=0.0, at_most=0.3, doc="pile yarn drawn for a knot, waste included")
    speed_limit: float = param(
        1.0, unit="m/s", at_least=1e-3, at_most=100.0, doc="allowed speed of grippers, sley and handler's tip"
    )
    acceleration_limit: float = param(
        20.0, unit="m/s^2", at_least=1e-3, at_most=1e5, doc="allowed acceleration of the same"
    )
    tool_mass: float = param(0.15, unit="kg", at_least=0.0, at_most=100.0, doc="mass that each cam moves")
    knot_pitch: float = param(0.004, unit="mm", at_least=1e-6, at_most=0.1, doc="distance of neighbouring knots")
    carriage_speed: float = param(0.25, unit="m/s", at_least=1e-3, at_most=100.0, doc="speed of the head along the row")
    carriage_acceleration: float = param(
        2.0, unit="m/s^2", at_least=1e-3, at_most=1e5, doc="acceleration of the head along the row"
    )
    carriage_jerk: float = param(100.0, unit="m/s^3", at_least=1e-3, at_most=1e9, doc="jerk of the head along the row")
    tubes: int = param(16, at_least=1, at_most=255, doc="yarn tubes, one for each colour")
    tube_pitch: float = param(0.012, unit="mm", at_least=1e-6, at_most=1.0, doc="distance of neighbouring tubes")
    selector_speed: float = param(0.2, unit="m/s", at_least=1e-3, at_most=100.0, doc="speed of the colour selector")
    selector_acceleration: float = param(
        1.0, unit="m/s^2", at_least=1e-3, at_most=1e5, doc="acceleration of the colour selector"
    )
    selector_jerk: float = param(50.0, unit="m/s^3", at_least=1e-3, at_most=1e9, doc="jerk of the colour selector")

    def check_together(self) -> None:
        """The steps of the turn follow each other, each with angle enough."""
        ends = {"prepare_end": self.prepare_end, "open_end": self.open_end, "knot_end": self.knot_end}
        before, at = "the beginning of the turn", 0.0
        for name, end in (*ends.items(), ("press_end", self.press_end)):
            if end < at + LEAST_STEP:
                raise ParameterError(
                    f"{name}={format_quantity(end, 'deg')} leaves the step after {before} no room",
                    allowed=f"at least {format_quantity(at + LEAST_STEP, 'deg')}",
                )
            before, at = name, end
