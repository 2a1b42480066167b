"""Outlines of the items of a part of several shapes, with the dimensions that the words of its cut list do not tell."""

from collections.abc import Iterator

import numpy as np

from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism
from ilmek.plane.contours import as_hole, as_keyed
from ilmek.report import Contour
from ilmek.report.sheet import SheetText
from ilmek.sentences import Sentence
from ilmek.viz.drawings.features import split_holes, square_of
from ilmek.viz.drawings.flat import flat_part, outline_view
from ilmek.viz.drawings.joined import Member, members_by_section
from ilmek.viz.drawings.paper import scale_words
from ilmek.viz.drawings.picture import SheetPicture


def member_outlines(members: tuple[Member, ...], scale: float) -> Iterator[SheetPicture]:
    """A view along the axis of each item that is neither round nor a rectangle, with its cutouts and details.

    Its round holes stand in the hole table.
    """
    for number, own in enumerate(members_by_section(members).values(), 1):
        sections = dict.fromkeys(member.section for member, _ in own if isinstance(member, Prism))
        for section in sections:
            _, cutouts = split_holes(section.holes)
            if _is_plain(section.outline) and not cutouts:
                continue
            flat = flat_part(Profile(section.outline, cutouts))
            if not flat.dimensioned:
                continue
            view, details = outline_view(flat, scale)
            top = complex(view.body[0], view.picture.box[3] + 3.0)
            words = Sentence("sheet.item-outline", item=str(number), scale=scale_words(1e3 / scale))
            view.text(SheetText(top, words, 2.5, bold=True))
            yield from (view.picture, *details)


def _is_plain(outline: Contour) -> bool:
    """Whether an outline is a circle, with a keyway or not, or has four corners at right angles."""
    if as_hole(outline) is not None or as_keyed(outline) is not None or square_of(outline) is not None:
        return True
    points = outline.points
    if len(points) != _CORNERS or outline.bulges.any():
        return False
    sides = np.roll(points, -1) - points
    return bool(np.abs(sides[:2] + sides[2:]).max() < _SAME and abs((sides[0] * sides[1].conjugate()).real) < _SAME**2)


_CORNERS, _SAME = 4, 1e-7
