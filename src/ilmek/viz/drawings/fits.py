"""Fits of a part's features beside their dimensions, and the table of all that its features must hold."""

from collections.abc import Iterator, Mapping, Sequence

from ilmek.part.guided_widths import guided_widths
from ilmek.part.tolerances import FeatureKind, GeometricTolerance, ToleratedFeature
from ilmek.records import record
from ilmek.sentences import Sentence
from ilmek.units import um
from ilmek.viz.drawings.feature_note import ControlFrame, FeatureNote
from ilmek.viz.drawings.features import SAME
from ilmek.viz.drawings.paper import table
from ilmek.viz.drawings.picture import SheetPicture, millimetres

Span = tuple[float, float]


def deviation(value: float) -> str:
    """A limit deviation in mm with its sign.

    >>> deviation(21e-6), deviation(0.0)
    ('+0.021', '0')
    """
    return "0" if abs(value) < 0.05 * um else f"{value * 1e3:+.3f}".replace("-", "−")


def limits(lower: float, upper: float) -> str:
    """Limit deviations in brackets; "" where both are 0: those of a thread stand in its class.

    >>> limits(-20e-6, -7e-6)
    ' (−0.007/−0.020)'
    """
    return f" ({deviation(upper)}/{deviation(lower)})" if lower or upper else ""


@record
class Fits:
    """The tolerated features of a part, and Ra of all its other surfaces [m], None where they are as delivered."""

    features: tuple[ToleratedFeature, ...] = ()
    general: float | None = None

    def note(self, size: float, kind: FeatureKind, centre: complex | None = None) -> FeatureNote:
        """What features of a size [m] and kind must hold: ` H7 (+0.021/0)`, frames, datums; bare: nothing.

        centre  of a bore in the section of a plate; None: anywhere
        """
        there = (
            feature for feature in self.features if feature.kind is kind and abs(feature.nominal - size) < 2 * SAME
        )
        return self.joined(
            [one for one in there if centre is None or abs(complex(*one.position.origin[:2]) - centre) < 2 * SAME]
        )

    def along(self, size: float, kind: FeatureKind) -> Mapping[FeatureNote, list[Span]]:
        """What features of a size [m] and kind on one axis must hold, and where they begin and end on it [m]."""
        notes: dict[FeatureNote, list[Span]] = {}
        for feature in self.features:
            if feature.kind is kind and abs(feature.nominal - size) < 2 * SAME:
                notes.setdefault(self.joined([feature]), []).append(span_of(feature))
        return notes

    def joined(self, alike: Sequence[ToleratedFeature]) -> FeatureNote:
        """What alike features must hold, as one note."""
        words = dict.fromkeys(f" {feature.tolerance}{limits(feature.lower, feature.upper)}" for feature in alike)
        frames = dict.fromkeys(_frame(limit) for feature in alike for limit in feature.geometric)
        rough = {f"Ra {feature.roughness / um:g}" for feature in alike if feature.roughness != self.general}
        datums = sorted({feature.datum for feature in alike if feature.datum})
        return FeatureNote(",".join(words), tuple(frames), tuple(datums), min(rough, default=""))

    def depth(self, size: float) -> str:
        """Deviations behind the depth of a keyway by its width [m]; "": it has no fit."""
        for feature in self.features:
            if feature.depth > 0 and abs(feature.nominal - size) < 2 * SAME:
                return limits(feature.depth_lower, feature.depth_upper)
        return ""

    def table(self) -> SheetPicture | None:
        """Size and limits of each kind of feature [mm], with what it does."""
        rows = list(dict.fromkeys(self._rows()))
        return table(HEADER, rows, Sentence("sheet.fits")) if rows else None

    def _rows(self) -> Iterator[tuple[str, ...]]:
        for feature in self.features:
            if feature.tolerance:
                ends = feature.nominal + feature.lower, feature.nominal + feature.upper
                least, greatest = map(millimetres, ends) if feature.lower or feature.upper else ("", "")
                kind, size, duty = named_feature(feature)
                yield kind, size, least, greatest, duty
        for slot, zone in guided_widths(self.features):
            kind = Sentence("sheet.kind-slot" if slot else "sheet.kind-tongue")
            ends = millimetres(zone.nominal + zone.lower), millimetres(zone.nominal + zone.upper)
            yield kind, f"{millimetres(zone.nominal)} {zone.name}", *ends, Sentence("sheet.duty-sliding")


def named_feature(feature: ToleratedFeature) -> tuple[str, str, str]:
    """What a feature is, its size with its class [mm], and what it does."""
    size = f"{_SIGNS.get(feature.kind, '')}{millimetres(feature.nominal)} {feature.tolerance}".rstrip()
    kind = Sentence(f"sheet.kind-{feature.kind.name.lower().replace('_', '-')}")
    return kind, size, Sentence(f"sheet.duty-{feature.duty.name.lower()}")


def span_of(feature: ToleratedFeature) -> Span:
    """Where a feature on the axis of a turned part begins and ends on it [m]."""
    begin = float(feature.position.origin[2])
    low, high = sorted((begin, begin + float(feature.position.rotation[2, 2]) * feature.length))
    return low, high


def _frame(limit: GeometricTolerance) -> ControlFrame:
    return ControlFrame(limit.characteristic, f"{'⌀' * limit.round}{millimetres(limit.value)}", limit.datums)


HEADER = tuple(map(Sentence, ("sheet.feature", "sheet.dimension", "sheet.least", "sheet.greatest", "sheet.duty")))
_SIGNS = {FeatureKind.BORE: "⌀", FeatureKind.JOURNAL: "⌀", FeatureKind.THREAD: "M", FeatureKind.SQUARE: "□"}
_SIGNS |= {FeatureKind.SQUARE_BORE: "□", FeatureKind.OUTER_THREAD: "M"}
