"""Fits of a part's features beside their dimensions, and the table of all that its features must hold."""

from collections.abc import Iterator

from ilmek.part.tolerances import FeatureKind, ToleratedFeature
from ilmek.records import record
from ilmek.units import um
from ilmek.viz.drawings.features import SAME
from ilmek.viz.drawings.paper import table
from ilmek.viz.drawings.picture import SheetPicture, millimetres


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
    """The tolerated features of a part."""

    features: tuple[ToleratedFeature, ...] = ()

    def suffix(self, size: float, kind: FeatureKind, centre: complex | None = None) -> str:
        """Classes, deviations and datum letters behind a size [m]: ` H7 (+0.021/0) [A]`; "": it has no fit.

        centre  of a bore in the section of a plate; None: anywhere
        """
        classes: dict[str, str] = {}
        for feature in self.features:
            at = complex(*feature.position.origin[:2])
            there = centre is None or abs(at - centre) < 2 * SAME
            if feature.kind is kind and there and abs(feature.nominal - size) < 2 * SAME:
                words = f" {feature.tolerance}{limits(feature.lower, feature.upper)}"
                classes[words] = classes.get(words, "") + (f" [{feature.datum}]" if feature.datum else "")
        return ",".join(f"{words}{datums}" for words, datums in classes.items())

    def depth(self, size: float) -> str:
        """Deviations behind the depth of a keyway by its width [m]; "": it has no fit."""
        for feature in self.features:
            if feature.depth > 0 and abs(feature.nominal - size) < 2 * SAME:
                return limits(feature.depth_lower, feature.depth_upper)
        return ""

    def table(self) -> SheetPicture | None:
        """Size, deviations, roughness and geometric tolerances of each kind of feature, with the reason."""
        rows = list(dict.fromkeys(self._rows()))
        return table(HEADER, rows, "Fits, form and position") if rows else None

    def _rows(self) -> Iterator[tuple[str, ...]]:
        for feature in self.features:
            size = f"{_SIGNS.get(feature.kind, '')}{millimetres(feature.nominal)} {feature.tolerance}"
            geometry = ", ".join(
                " ".join((limit.characteristic, f"{'⌀' * limit.round}{millimetres(limit.value)}", *limit.datums))
                for limit in feature.geometric
            )
            roughness = f"{feature.roughness / um:g}"
            yield feature.kind.value, size, feature.datum, roughness, geometry, feature.duty.value


HEADER = ("Feature", "Size", "Datum", "Ra", "Form, position", "It")
_SIGNS = {FeatureKind.BORE: "⌀", FeatureKind.JOURNAL: "⌀", FeatureKind.THREAD: "M", FeatureKind.SQUARE: "□"}
_SIGNS[FeatureKind.SQUARE_BORE] = "□"
