"""Plane faces that must hold a form: their frames at the line as which a view shows them."""

from collections import defaultdict
from typing import TypeAlias

import numpy as np

from ilmek.arrays import Float
from ilmek.part.tolerances import FeatureKind, FitDuty
from ilmek.sentences import Sentence
from ilmek.viz.drawings.feature_note import FeatureNote
from ilmek.viz.drawings.fits import Fits
from ilmek.viz.drawings.view import DrawnView

Direction: TypeAlias = Float[np.ndarray, " 3"]

X, Y, Z = np.eye(3)
FRONT = X, Y
"""Directions to the right and upwards on the paper, of the view along a section's normal."""


def face_notes(view: DrawnView, fits: Fits, right: Direction, up: Direction) -> None:
    """The notes of the faces that a view shows from the edge, by its directions to the right and upwards; of many alike
    one.
    """
    alike = defaultdict[tuple[FitDuty, FeatureNote], list[tuple[complex, complex]]](list)
    for feature in fits.features:
        middle, normal = feature.position.origin, feature.position.rotation[:, 2]
        if feature.kind is FeatureKind.FACE and abs(float(normal @ np.cross(right, up))) < _EDGE_ON:
            foot = complex(float(middle @ right), float(middle @ up)) * view.scale
            out = complex(float(normal @ right), float(normal @ up))
            alike[feature.duty, fits.note(feature.nominal, feature.kind)].append((foot, out))
    for (duty, note), spots in alike.items():
        many, words = len(spots) > _EACH, Sentence(f"sheet.duty-{duty.name.lower()}")
        words = Sentence("sheet.alike-faces", number=len(spots), duty=words) if many else words
        for foot, out in spots[:1] if many else spots:
            sector = foot - 1j * out, foot + 1j * out
            view.leader(words, foot, 0.0, kind=None, sector=sector, note=note)


_EACH = 4
"""Alike faces up to which each has its note."""

_EDGE_ON = 0.1
"""Greatest sine of the angle between a face and the eye."""
