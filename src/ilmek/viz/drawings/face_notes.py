"""Plane faces that must hold a form: their frames at the line as which a view shows them."""

from typing import TypeAlias

import numpy as np

from ilmek.arrays import Float
from ilmek.part.tolerances import FeatureKind
from ilmek.sentences import Sentence
from ilmek.viz.drawings.fits import Fits
from ilmek.viz.drawings.view import DrawnView

Direction: TypeAlias = Float[np.ndarray, " 3"]

X, Y, Z = np.eye(3)
FRONT = X, Y
"""Directions to the right and upwards on the paper, of the view along a section's normal."""


def face_notes(view: DrawnView, fits: Fits, right: Direction, up: Direction) -> None:
    """The notes of the faces that a view shows from the edge, by its directions to the right and upwards."""
    for feature in fits.features:
        middle, normal = feature.position.origin, feature.position.rotation[:, 2]
        if feature.kind is FeatureKind.FACE and abs(float(normal @ np.cross(right, up))) < _EDGE_ON:
            foot = complex(float(middle @ right), float(middle @ up)) * view.scale
            out = complex(float(normal @ right), float(normal @ up))
            note = fits.note(feature.nominal, feature.kind)
            sector = foot - 1j * out, foot + 1j * out
            view.leader(
                Sentence(f"sheet.duty-{feature.duty.name.lower()}"), foot, 0.0, kind=None, sector=sector, note=note
            )


_EDGE_ON = 0.1
"""Greatest sine of the angle between a face and the eye."""
