"""Stages of a chart, so that a caller who changes an order again and again can keep what does not change."""

from collections.abc import Callable, Hashable
from typing import TypeVar

from ilmek.arrays import Rgb
from ilmek.carpet.flat import Flatness
from ilmek.carpet.reading import Design

T = TypeVar("T")


class Stages:
    """The stages of a chart, each made when it is needed; a subclass may keep their results.

    in_shades   the yarns of the order are shades that were chosen for its picture before
    with_whole  where the fitted picture is wanted, the picture before it was cropped is wanted too
    """

    in_shades: bool = False
    with_whole: bool = True

    def keep(self, stage: str, key: Hashable, make: Callable[[], T]) -> T:
        """The result of a stage: of `make`, or as it was kept of an equal key. Whoever takes it must not change it."""
        del stage, key
        return make()

    def seen(self, picture: Hashable, knots: int, look: Callable[[], Flatness]) -> Flatness:
        """Whether a part of a picture, for so many knots, is a drawing: as `look` sees it."""
        del picture, knots
        return look()

    def to_turn(self, picture: Hashable, rgb: Rgb, knots: int) -> Rgb:
        """A picture of so many knots that is turned by an angle, which makes each of its pixels anew: as it is."""
        del picture, knots
        return rgb

    def shown(self, key: Hashable, design: Design) -> Design:
        """The design of a key before its tone is changed and its yarns are chosen: as it is."""
        del key
        return design


ANEW = Stages()
"""Every stage is made anew."""
