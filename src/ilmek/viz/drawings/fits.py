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


@record
class Fits:
    """The tolerated features of a part."""

    features: tuple[ToleratedFeature, ...] = ()

    def suffix(self, diameter: float, kind: FeatureKind) -> str:
        """Class and deviations behind a diameter [m] of a bore, journal or keyway: ` H7 (+0.021/0)`; "": none."""
        for feature in self.features:
            if feature.kind is kind and abs(feature.nominal - diameter) < 2 * SAME and feature.tolerance:
                return f" {feature.tolerance} ({deviation(feature.upper)}/{deviation(feature.lower)})"
        return ""

    def table(self) -> SheetPicture | None:
        """Size, deviations, roughness and geometric tolerances of each kind of feature, with the reason."""
        rows = list(dict.fromkeys(self._rows()))
        return table(("Feature", "Size", "Deviations", "Ra µm", "Geometry", "For"), rows, "Fits") if rows else None

    def _rows(self) -> Iterator[tuple[str, ...]]:
        for feature in self.features:
            round_one = feature.kind in {FeatureKind.BORE, FeatureKind.JOURNAL}
            size = f"{'⌀' if round_one else ''}{millimetres(feature.nominal)} {feature.tolerance}".strip()
            limits = f"{deviation(feature.upper)} / {deviation(feature.lower)}" if feature.tolerance else ""
            geometry = ", ".join(
                " ".join((limit.characteristic, f"{'⌀' * limit.round}{millimetres(limit.value)}", *limit.datums))
                for limit in feature.geometric
            )
            yield feature.kind.value, size, limits, f"{feature.roughness / um:g}", geometry, feature.reason[:40]
