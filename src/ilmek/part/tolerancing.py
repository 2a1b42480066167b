"""Tolerances of made parts from what meets in their joints: fits, form and position, surfaces.

A feature is a cylinder or a square of a part's shape, or its keyway. Its fit is that of the meeting with another part,
which follows from the joint between them [`meetings`]; both parts read it from there, and none types it a second time:

    runs or slides                     H7/g6; on a journal that is also fixed in a part: G7/h6; a rod or wire in a bore
                                       longer than 20 diameters, which is drilled, not reamed: H11/c11
    fixed                              H7/m6; on a journal on which a part also runs: P7/h6; a bush in its hub H7/s6
    with a keyway                      H7/h6; the keyway N9 in the shaft, JS9 in the hub
    square                             H9/h11, as laser-cut H12: the bar is bright drawn
    seat of a rolling bearing          shaft k6, up to 18 mm js6; where its outer ring turns, of an insert bearing with
                                       grub screws and of a freewheel h6; housing H7, of a freewheel N7
    what turns, about its bore         h6, run-out to the bore; a roller
    end of a screw                     thread 6H; under a locknut 6g
    face under a bought guide          flat
    faces that slide on each other     flat
    faces of a disc cam                run-out to its bore

Sources: DIN 6885-1 (light fit), ISO 4379 (bushes), ISO 965-1 (threads); rolling bearings of the class Normal under
normal loads: SKF, Rolling bearings, tables of fits, of roughness and of geometrical tolerances of seats, IT5 / 2 of a
shaft and IT6 / 2 of a housing; freewheels: INA, HF. The other fits are usual choices, as are the surfaces.
"""

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.elements.bearing_table import INSERT
from ilmek.elements.bearings import find_bearing
from ilmek.elements.fits import tolerance_grade, tolerance_zone
from ilmek.elements.keyways import Keyway
from ilmek.elements.locknuts import Locknut, locknut_of
from ilmek.elements.making import DRAWN, FINEST, LASER
from ilmek.errors import ParameterError
from ilmek.part.blanks import SHEET, STOCK
from ilmek.part.datums import related
from ilmek.part.features import FeatureOfSize, features_of_size
from ilmek.part.meetings import GuideSeat, Meeting, SeatFeature, guide_seats, meetings, slide_seats
from ilmek.part.placement import Placement, placement
from ilmek.part.shapes import Prism, Turned
from ilmek.part.specification import AS_DELIVERED
from ilmek.part.tolerances import Characteristic, FeatureKind, FitDuty, GeometricTolerance, ToleratedFeature
from ilmek.part.tree import JointKind, Tree
from ilmek.records import record
from ilmek.units import mm, um


def play_of(tree: Tree, outer: str, inner: str) -> float:
    """Largest clearance [m] of a part in a bore of another, by their ids; below 0 it is an interference.

    Raises ParameterError where they do not meet with fits.
    """
    tolerances = tolerances_of(tree)
    pairs = [
        bore.upper - journal.lower
        for bore in tolerances.get(outer, ())
        for journal in tolerances.get(inner, ())
        if inner in bore.mates and outer in journal.mates and bore.nominal == journal.nominal
        if not bore.depth and not journal.depth
    ]
    if not pairs:
        raise ParameterError(f"the fit of {inner} in {outer}", allowed="parts that meet")
    return max(pairs)


@record
class _Met:
    """A feature with its meetings, and what it does in each."""

    seat: SeatFeature
    others: tuple[tuple[FitDuty, SeatFeature, Meeting], ...]

    @property
    def duty(self) -> FitDuty:
        """The first of its duties, in the order in which they decide."""
        keyed = (FitDuty.KEYED,) if self.seat.feature.keyway is not None else ()
        duties = {*keyed, *(duty for duty, _, _ in self.others)} or {FitDuty.ROLLING}
        return next(duty for duty in FitDuty if duty in duties)

    @property
    def cut(self) -> bool:
        """Whether its part is cut from sheet, and not machined."""
        return self.seat.part.process in SHEET and not self.seat.part.machined

    def has(self, duty: FitDuty) -> bool:
        """Whether it does this, too."""
        return any(own == duty for own, _, _ in self.others)


@lru_cache(maxsize=8)
def tolerances_of(tree: Tree) -> Mapping[str, tuple[ToleratedFeature, ...]]:
    """The tolerated features of the made parts of a tree by their ids, those of size along with their keyways."""
    met = dict(_met(tree))
    journals = {key: _journal(one, met) for key, one in met.items() if not one.seat.feature.inside}
    features: dict[str, list[ToleratedFeature]] = defaultdict(list)
    for key, one in met.items():
        if one.seat.part.material is not None:
            tolerance = journals[key] if key in journals else _bore(one, journals)
            features[key[0]] += _with_keyways(_sized(one, tolerance), one.seat.feature)
    for seat in (*guide_seats(tree), *slide_seats(tree)):
        machined = seat.part.machined or seat.part.process not in AS_DELIVERED
        if machined and seat.part.material is not None:  # what is not machined is shimmed
            features[seat.part.id].append(_face(seat))
    for part, _ in tree.occurrences():
        if part.cam is not None and isinstance(part.shape, Prism) and part.id in features:
            features[part.id] += _cam_faces(part.id, part.shape)
    return {part: tuple(related(_named(own))) for part, own in features.items()}


_Key = tuple[str, int]


def _met(tree: Tree) -> Iterator[tuple[_Key, _Met]]:
    """The features that meet another, or have a keyway, and the outsides of rollers."""
    others: dict[_Key, list[tuple[FitDuty, SeatFeature, Meeting]]] = defaultdict(list)
    seats: dict[_Key, SeatFeature] = {}
    turning = (own.part for body in tree.bodies for own in body.occurrences if own.turning)
    rollers = {part.id for part in turning if isinstance(part.shape, Turned)}
    for part, _ in tree.occurrences():
        if part.shape is not None and part.material is not None:
            for number, feature in enumerate(features_of_size(part.shape)):
                if feature.keyway is not None or (part.id in rollers and not feature.inside):
                    seats[part.id, number] = SeatFeature(part, number, feature)
    for meeting in meetings(tree):
        for own, other in ((meeting.bore, meeting.inner), (meeting.inner, meeting.bore)):
            duty = _duty(meeting, own, other)
            if duty is not None:
                seats[own.part.id, own.number] = own
                others[own.part.id, own.number].append((duty, other, meeting))
    return ((key, _Met(seats[key], tuple(others[key]))) for key in sorted(seats))


def _duty(meeting: Meeting, own: SeatFeature, other: SeatFeature) -> FitDuty | None:
    """What a feature does in a meeting; None: nothing that a fit is needed for, as a hole around a screw."""
    if own.feature.square and "welded frame" in (own.part.process, other.part.process):
        return None  # a hollow section as delivered, welded in
    if other.part.process in {"fastener", "levelling foot"}:
        screwed = meeting.ends if own is meeting.bore else _locknut(other) is not None
        return FitDuty.SCREWED if screwed else None
    if other.part.process == "bearing":
        return FitDuty.HOUSING if own is meeting.bore else FitDuty.BEARING
    if meeting.joint is not JointKind.FIXED and not _on_motor(own, other):
        return FitDuty.RUNNING
    return FitDuty.KEYED if own.feature.keyway or other.feature.keyway else FitDuty.FIXED


def _on_motor(*seats: SeatFeature) -> bool:
    """Whether one of two features is the shaft of a motor, which turns in it."""
    return any(seat.part.purchase is not None and seat.part.purchase.drives for seat in seats)


def _locknut(seat: SeatFeature) -> Locknut | None:
    """The locknut that a feature is the bore of, if any."""
    return locknut_of(seat.part.purchase.row) if seat.part.purchase is not None else None


_LONG = 20.0
"""Length over diameter from which a bore is drilled deep, and not reamed; assumed by this project."""


def _is_long(duty: FitDuty, meeting: Meeting) -> bool:
    """Whether a journal runs in a bore that is long over its diameter."""
    (low, high), inner = meeting.along, meeting.inner.feature
    within = min(high, inner.length) - max(low, 0.0)
    return duty is FitDuty.RUNNING and within > _LONG * inner.size


_SMALL = 18 * mm
"""Bore up to which a bearing's shaft is js6."""


def _journal(one: _Met, met: Mapping[_Key, _Met]) -> str:
    """Tolerance class of a journal or a square."""
    if one.seat.feature.square:
        return f"h{DRAWN}"
    if one.duty in {FitDuty.SCREWED, FitDuty.BEARING}:
        nuts = (nut.thread_class for _, other, _ in one.others if (nut := _locknut(other)) is not None)
        rings = (_bearing_shaft(other, meeting) for duty, other, meeting in one.others if duty is FitDuty.BEARING)
        return min(rings, default="") or next(nuts)
    if one.duty is FitDuty.RUNNING:
        if any(_is_long(own, meeting) for own, _, meeting in one.others):
            return "c11"
        return "h6" if one.has(FitDuty.FIXED) or one.has(FitDuty.KEYED) else "g6"
    if one.duty in {FitDuty.KEYED, FitDuty.ROLLING}:
        return "h6"
    own = (other for (part, _), other in met.items() if part == one.seat.part.id)
    bush = any(other.seat.feature.inside and other.has(FitDuty.RUNNING) for other in own)
    return "s6" if bush and one.seat.part.process not in STOCK else "m6"


def _bearing_shaft(other: SeatFeature, meeting: Meeting) -> str:
    """Tolerance class of the seat of a bearing's inner ring; h6 where the load does not turn on it."""
    part = other.part
    try:
        inserted = part.purchase is None or find_bearing(part.purchase.row).kind == INSERT
    except ParameterError:  # a freewheel, an idler
        inserted = True
    if inserted or meeting.joint is JointKind.FIXED:
        return "h6"
    return "js6" if other.feature.size <= _SMALL + um else "k6"


def _bore(one: _Met, journals: Mapping[_Key, str]) -> str:
    """Tolerance class of a bore: by that of the journal in it."""
    if one.duty is FitDuty.SCREWED:
        return "6H"
    if one.seat.feature.square:
        return f"H{FINEST[LASER]}" if one.cut else "H9"
    if one.duty is FitDuty.HOUSING:
        rings = (other.part.purchase for duty, other, _ in one.others if duty is FitDuty.HOUSING)
        return next((ring.housing for ring in rings if ring is not None), "H7")
    classes = {
        journals[other.part.id, other.number]
        for duty, other, _ in one.others
        if duty in {FitDuty.RUNNING, FitDuty.FIXED}
    }
    if "c11" in classes:
        return "H11"
    if one.duty in {FitDuty.RUNNING, FitDuty.FIXED} and classes == {"h6"}:
        return "G7" if one.duty is FitDuty.RUNNING else "P7"
    return "H7"


_ROUGH = {
    FitDuty.HOUSING: 1.6 * um,
    FitDuty.BEARING: 0.8 * um,
    FitDuty.RUNNING: 0.4 * um,
    FitDuty.KEYED: 1.6 * um,
    FitDuty.FIXED: 1.6 * um,
    FitDuty.SCREWED: 3.2 * um,
    FitDuty.GUIDING: 1.6 * um,
    FitDuty.SLIDING: 0.8 * um,
    FitDuty.ROLLING: 0.4 * um,
    FitDuty.TRACK: 3.2 * um,
}
"""Ra by duty [m]; a bore in which a journal runs is twice as rough."""

_CUT = 12.5 * um
"""Ra of a laser's cut [m]: about a fifth of its Rz, range 3 of ISO 9013."""

_SIDES = 3.2 * um
"""Ra of a keyway's sides [m]."""

_KINDS = {
    (True, False): FeatureKind.BORE,
    (False, False): FeatureKind.JOURNAL,
    (True, True): FeatureKind.SQUARE_BORE,
    (False, True): FeatureKind.SQUARE,
}

_THREADS = {True: FeatureKind.THREAD, False: FeatureKind.OUTER_THREAD}


def _sized(one: _Met, tolerance: str) -> ToleratedFeature:
    """The feature with its size, form and surface."""
    feature, duty = one.seat.feature, one.duty
    size = round(feature.size, 9)
    threaded = duty is FitDuty.SCREWED
    zone = None if threaded else tolerance_zone(tolerance, size)
    mates = dict.fromkeys(other.part.id for _, other, _ in one.others)
    rough = _ROUGH[duty] * (2 if duty is FitDuty.RUNNING and feature.inside else 1)
    if feature.square and feature.inside and one.cut:
        rough = _CUT
    return ToleratedFeature(
        part=one.seat.part.id,
        name="",
        kind=_THREADS[feature.inside] if threaded else _KINDS[feature.inside, feature.square],
        position=feature.position,
        length=feature.length,
        nominal=size,
        tolerance=tolerance,
        lower=0.0 if zone is None else zone.lower,
        upper=0.0 if zone is None else zone.upper,
        roughness=rough,
        duty=duty,
        geometric=tuple(_form(duty, size)),
        mates=tuple(mates),
        joint=next((meeting.body for own, _, meeting in one.others if own is duty), ""),
    )


def _face(seat: GuideSeat) -> ToleratedFeature:
    """The face under a guide, or on which a part slides."""
    flat = round(max(_FLAT * seat.length, _LEAST_FLAT), 6)
    duty = FitDuty.SLIDING if seat.slides else FitDuty.GUIDING
    reason = "what slides bears on all of its face" if seat.slides else "a guide takes the form of its seat"
    return ToleratedFeature(
        part=seat.part.id,
        name="",
        kind=FeatureKind.FACE,
        position=seat.position,
        length=0.0,
        nominal=round(seat.length, 9),
        tolerance="",
        lower=0.0,
        upper=0.0,
        roughness=_ROUGH[duty],
        duty=duty,
        geometric=(GeometricTolerance(Characteristic.FLATNESS, flat, reason=reason),),
        mates=(seat.guide.id,),
        joint=seat.body,
    )


def _cam_faces(name: str, shape: Prism) -> Iterator[ToleratedFeature]:
    """Both faces of a disc cam, whose run-out would take its track from under the roller."""
    outer = float(np.abs(shape.section.outline.points).max())
    inner = max(float(np.abs(hole.points).max()) for hole in shape.section.holes)
    middle = (inner + float(np.abs(shape.section.outline.points).min())) / 2
    for end, about in ((0.0, math.pi), (shape.length, 0.0)):
        yield ToleratedFeature(
            part=name,
            name="",
            kind=FeatureKind.FACE,
            position=placement(0.0, middle, end, about=(0.0, 1.0, 0.0), angle=about),
            length=0.0,
            nominal=round(2 * outer, 9),
            tolerance="",
            lower=0.0,
            upper=0.0,
            roughness=_ROUGH[FitDuty.TRACK],
            duty=FitDuty.TRACK,
        )


_FLAT, _LEAST_FLAT = 30 * um / 1.0, 10 * um
"""Flatness of a guide's seat over its length, and the least [m]; assumed by this project, as makers of rails ask."""


def _form(duty: FitDuty, size: float) -> Iterator[GeometricTolerance]:
    grade = {FitDuty.BEARING: 5, FitDuty.HOUSING: 6}.get(duty)
    if grade is not None:
        reason = "the ring of a bearing takes the form of its seat"
        yield GeometricTolerance(Characteristic.CYLINDRICITY, tolerance_grade(grade, size) / 2, reason=reason)


def _with_keyways(own: ToleratedFeature, feature: FeatureOfSize) -> Iterator[ToleratedFeature]:
    yield own
    if feature.keyway is not None:
        for angle in (0.0, *feature.others):
            turned = placement(about=(0.0, 0.0, 1.0), angle=angle)
            yield _keyway(own, feature.keyway, turned, inside=feature.inside)


def _keyway(own: ToleratedFeature, row: Keyway, turned: Placement, *, inside: bool) -> ToleratedFeature:
    tolerance = "JS9" if inside else "N9"
    zone, deviation = tolerance_zone(tolerance, row.width), _deeper(row)
    return replace(
        own,
        kind=FeatureKind.HUB_KEYWAY if inside else FeatureKind.SHAFT_KEYWAY,
        position=own.position.after(turned),
        nominal=row.width,
        tolerance=tolerance,
        lower=zone.lower,
        upper=zone.upper,
        roughness=_SIDES,
        depth=own.nominal + (row.in_hub if inside else -row.in_shaft),
        depth_lower=0.0 if inside else -deviation,
        depth_upper=deviation if inside else 0.0,
        geometric=(),
    )


def _deeper(row: Keyway) -> float:
    """Allowed deviation of t1 and t2 [m]: DIN 6885-1, keys up to 6 mm high, and higher ones."""
    return 0.1 * mm if row.height <= 6 * mm + um else 0.2 * mm


def _named(features: Sequence[ToleratedFeature]) -> list[ToleratedFeature]:
    """The features with their names: of each kind in order."""
    numbers: dict[FeatureKind, int] = defaultdict(int)
    named = []
    for feature in features:
        numbers[feature.kind] += 1
        named.append(replace(feature, name=f"{feature.kind.value.replace(' ', '-')}-{numbers[feature.kind]}"))
    return named
