"""Names that one table of a mechanism file has for entries of another, and entries that many tables have."""

from collections.abc import Iterable

from ilmek.errors import MechanismError, did_you_mean
from ilmek.io.declared import ListEntry, QuantityEntry, SpotEntry, TextEntry, quantity
from ilmek.io.schema import Measured
from ilmek.linkage.model import Input, Joint, Mechanism, Rotation, Slide

MOST_ENTRIES = 100
"""Largest number of bodies, of joints, of couplings, and of loads, springs or dampers of a file."""

LENGTH = quantity("m", 'like "60mm"')
ANGLE = quantity("rad", 'like "170deg"')
XY = ListEntry("x and y", LENGTH, 2, 2)
SPOT = SpotEntry("a body and its point")
MATERIAL = "of the table of materials"
LEAST_SIZE, GREATEST_SIZE = 1e-9, 1e15
"""Bounds of sizes and allowed stresses of sections and pins [SI], with which no power over- or underflows."""


def size(unit: str, doc: str = "") -> QuantityEntry:
    """A size or an allowed stress of a section or pin."""
    return quantity(unit, doc, least=LEAST_SIZE, most=GREATEST_SIZE)


def position_of_input(doc: str = "") -> QuantityEntry:
    """A value of an input, which turns or slides."""
    return quantity(("rad", "m"), doc)


def speed_of_input(doc: str = "") -> QuantityEntry:
    """A speed of an input, which turns or slides."""
    return quantity(("rad/s", "m/s"), doc)


def two_names(doc: str, refers: str) -> ListEntry:
    """Two bodies, or two points of a body."""
    return ListEntry(doc, TextEntry("", refers), 2, 2)


def two_spots(doc: str) -> ListEntry:
    """Two points of bodies."""
    return ListEntry(doc, SPOT, 2, 2)


def xy_of(point: complex) -> list[float]:
    """The coordinates of a point or vector."""
    return [float(point.real), float(point.imag)]


def parts_of(names: Iterable[str], mechanism: Mechanism) -> dict[str, tuple[Joint, ...]]:
    """Joint of the file -> the joints of two bodies into which it was divided."""
    own = tuple(names)
    return {
        name: tuple(
            joint
            for joint in mechanism.joints
            if joint.name == name or (is_part(joint.name, name) and joint.name not in own)
        )
        for name in own
    }


def is_part(joint: str, of: str) -> bool:
    """Whether a joint is one of a pin of several bodies, by its name `PIN.BODY`."""
    return joint.startswith(f"{of}.")


def input_of(name: str | None, mechanism: Mechanism) -> Input:
    """The input of a driven joint or body; None: the only input. Raises MechanismError for an unknown one."""
    inputs = mechanism.inputs
    if name is None:
        if len(inputs) != 1:
            names = ", ".join(entry.joint for entry in inputs) or "none"
            raise MechanismError(
                f"the input is not given, and the mechanism has {len(inputs)}", allowed=f"one of {names}"
            )
        return inputs[0]
    found = next((entry for entry in inputs if name in (entry.name, entry.joint, driven_body(entry, mechanism))), None)
    if found is None:
        known = [each for entry in inputs for each in (entry.joint, driven_body(entry, mechanism))]
        raise unknown("driven joint or body", name, known)
    return found


def unit_of(entry: Input) -> str:
    """The unit of an input's value."""
    return "rad" if isinstance(entry, Rotation) else "m"


def spot_of(given: tuple[str, str], mechanism: Mechanism) -> tuple[str, str]:
    """A body and its point. Raises MechanismError if the mechanism does not have them."""
    mechanism.point(*given)
    return given


def driven_body(entry: Input, mechanism: Mechanism) -> str:
    """The body that an input turns or shifts."""
    joint = mechanism.joint(entry.joint)
    return joint.body if isinstance(joint, Slide) else entry.name


def unknown(kind: str, name: str, known: Iterable[str]) -> MechanismError:
    """The error for a name that does not exist."""
    names = tuple(known)
    allowed = f"known: {', '.join(names) or 'none'}"
    return MechanismError(f"there is no {kind} {name!r}", allowed=allowed, do=did_you_mean(name, names))


def value_of(measured: Measured, unit: str, key: str) -> float:
    """The value of a quantity that must be of one unit's dimension here. Raises MechanismError for another."""
    if measured.unit not in ("", unit):
        raise MechanismError(
            f"{key} is a quantity in {measured.unit}", allowed=f"a quantity in {unit} is required here"
        )
    return measured.value
