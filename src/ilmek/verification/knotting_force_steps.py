"""Knotting report, section 5: its steps from the moments of the links to the joint forces, with and without its slips.

Forces at rest [N] and by ω1² [N s²]; inertia forces are printed in mN, and moments of them in mN mm and N m.
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple, TypeAlias

from ilmek.records import JsonObject
from ilmek.units import mm, mN
from ilmek.verification.claim import Step
from ilmek.verification.knotting_pose import xy

ARM_3 = "G3 from O1' in the moments"
YARN, WEIGHT_2, REST_2, SPIN_2 = (
    f"link 2: {term}" for term in ("moment of the yarn's 15 N", "moment of the weight", "moment at rest", "-J2 α2")
)
WEIGHT_3, SPIN_3, INERTIA_3 = (
    f"link 3: {term}" for term in ("moment of the weight", "-J3 α3", "moment of the inertia force")
)
DENOMINATOR, NUMERATOR_AT_REST, NUMERATOR_BY_SPEED = (
    f"F2'x: {term}" for term in ("denominator", "numerator at rest", "numerator by ω1²")
)
AT_REST, BY_SPEED = "at rest", "by ω1²"

Printed: TypeAlias = Mapping[str, float]
VectorStep: TypeAlias = Callable[[Printed], complex]


class SlippedStep(NamedTuple):
    """A step as the report takes it, its slips, and the same without them."""

    follows: VectorStep
    slips: tuple[str, ...] = ()
    right: VectorStep | None = None

    def of_claim(self) -> JsonObject:
        """The arguments of a claim."""
        return self._asdict()


def by_mass(of: Printed, link: int) -> complex:
    """The inertia force of link 2 or 3 [mN] from mass [g] and acceleration [mm/s²]."""
    return of[f"mass of link {link}"] * 1e-3 * xy(of, f"a of G{link}")


def moment_2(of: Printed) -> float:
    """What turns link 2 about O2 beside F2', by ω1² [N mm s²]."""
    arm, force = xy(of, "G2 from O2"), xy(of, "m2 a of G2")
    return of[SPIN_2] / mm - (arm.real * force.imag - arm.imag * force.real) * mN


def moment_3(of: Printed) -> float:
    """The same of link 3 about O1'."""
    return of[INERTIA_3] * mN + of[SPIN_3] / mm


def denominator(of: Printed, sign: int) -> float:
    """Of F2'x, from the moments of both links; the sign of F2'y on link 2: -1, +1 in the report."""
    third, second = xy(of, "O2' from O1'"), xy(of, "O2' from O2")
    return -third.imag * second.real - sign * third.real * second.imag


def numerator(of: Printed, sign: int, third: Step, second: Step) -> float:
    """Of F2'x, from the moments of links 3 and 2 beside it."""
    return third(of) * of["O2' from O2, x"] - sign * of["O2' from O1', x"] * second(of)


def moment_of_x(of: Printed, what: str) -> float:
    """About O1, of F2x."""
    return -of["O2 from O1, y"] * of[f"F2 {what}, x"]


def moment_of_y(of: Printed, what: str) -> float:
    """About O1, of F2y."""
    return of["O2 from O1, x"] * of[f"F2 {what}, y"]


def torque(of: Printed, what: str) -> float:
    """M1 from the moments of F2."""
    return -of[f"link 1: moment of F2x {what}"] - of[f"link 1: moment of F2y {what}"]


def _other_component(of: Printed, what: str, moment: float) -> complex:
    """F2' on links 2 and 3: x by its numerator, y from the moments of link 3."""
    x = of[NUMERATOR_AT_REST if what == AT_REST else NUMERATOR_BY_SPEED] / of[DENOMINATOR]
    arm = xy(of, "O2' from O1'")
    return complex(x, -(moment + arm.imag * x) / arm.real)


def _third_at_rest(of: Printed) -> complex:
    far = xy(of, "F2' at rest")
    return complex(far.real, of["weight of link 3"] - far.imag)


def _third_at_rest_by_report(of: Printed) -> complex:
    far = xy(of, "F2' at rest")
    return complex(-far.real, of["weight of link 3 in F1'y"] - far.imag)


def _third_by_speed(of: Printed, unit: float) -> complex:
    far = xy(of, "F2' by ω1²")
    return far.conjugate() + unit * xy(of, "m3 a of G3")


def _second_at_rest(of: Printed) -> complex:
    far = xy(of, "F2' at rest")
    return complex(far.real, 15 - far.imag - of["weight of link 2, as used"])


def _second_by_speed(of: Printed, unit: float) -> complex:
    return xy(of, "F2' by ω1²").conjugate() - unit * xy(of, "m2 a of G2")


def _first_at_rest(of: Printed) -> complex:
    pin = xy(of, "F2 at rest")
    return complex(pin.real, of["weight of link 1"] - pin.imag)


def _first_by_speed(of: Printed, unit: float) -> complex:
    pin, inertia = xy(of, "F2 by ω1²"), xy(of, "m1 a of G1")
    return complex(pin.real - unit * inertia.real, unit * inertia.imag - pin.imag)


MIXED = ("mN as N",)
JOINTS = {
    "F2' at rest": SlippedStep(lambda of: _other_component(of, AT_REST, of[WEIGHT_3])),
    "F1' at rest": SlippedStep(_third_at_rest_by_report, ("sign of F1'x",), _third_at_rest),
    "F2 at rest": SlippedStep(_second_at_rest),
    "F1 at rest": SlippedStep(_first_at_rest),
    "F2' by ω1²": SlippedStep(
        lambda of: _other_component(of, BY_SPEED, of[INERTIA_3]),
        MIXED,
        lambda of: _other_component(of, BY_SPEED, moment_3(of)),
    ),
    "F1' by ω1²": SlippedStep(lambda of: _third_by_speed(of, 1.0), MIXED, lambda of: _third_by_speed(of, mN)),
    "F2 by ω1²": SlippedStep(lambda of: _second_by_speed(of, 1.0), MIXED, lambda of: _second_by_speed(of, mN)),
    "F1 by ω1²": SlippedStep(lambda of: _first_by_speed(of, 1.0), MIXED, lambda of: _first_by_speed(of, mN)),
}
"""The steps to each joint force."""
