"""Tables and other pictures beside the views of a sheet: in columns on the right, then in rows below."""

from collections.abc import Iterable
from dataclasses import dataclass

from ilmek.viz.drawings.picture import Box, SheetPicture

BETWEEN, PAD = 14.0, 6.0
"""Least distance of two views, and of anything from the frame [mm]."""


def top_left(picture: SheetPicture, corner: complex) -> SheetPicture:
    """A picture with its upper left corner at a point [mm]."""
    return picture.moved(corner - complex(picture.box[0], picture.box[3]))


def packed(pictures: Iterable[SheetPicture], area: Box, views: complex) -> tuple[list[SheetPicture], Box] | None:
    """The pictures where they stand in an area, and what they leave of it; None: there is no room for all.

    views  width and height that must be left [mm]
    """
    packing, placed = _Packing(*area, views), list[SheetPicture]()
    for picture in pictures:
        size = complex(picture.box[2] - picture.box[0], picture.box[3] - picture.box[1])
        corner = packing.in_column(size) or packing.in_new_column(size) or packing.in_row(size)
        if corner is None:
            return None
        placed.append(top_left(picture, corner))
    return placed, (packing.left, packing.low, packing.right, packing.high)


@dataclass
class _Packing:
    """What is left of an area [mm]; its last column on the right and its last row below, by their free boxes."""

    left: float
    low: float
    right: float
    high: float
    views: complex
    column: Box | None = None
    row: Box | None = None

    def in_column(self, size: complex) -> complex | None:
        """The corner of what has room in the last column."""
        if self.column is None:
            return None
        left, low, right, high = self.column
        wider = max(0.0, size.real - (right - left))
        if size.imag > high - low or (wider and self.row) or wider > self.right - self.left - self.views.real:
            return None
        self.right -= wider
        self.column = left - wider, low, right, high - size.imag - PAD
        return complex(left - wider, high)

    def in_new_column(self, size: complex) -> complex | None:
        """The corner of what has room in a new column."""
        left = self.right - size.real
        if size.imag > self.high - self.low or left - BETWEEN - self.left < self.views.real:
            return None
        self.column = left, self.low, self.right, self.high - size.imag - PAD
        self.right = left - BETWEEN
        return complex(left, self.high)

    def in_row(self, size: complex) -> complex | None:
        """The corner of what has room in the last row, made higher, or in a new one."""
        room = self.high - self.views.imag
        last = [self.row[:3]] if self.row else []
        for left, low, right in (*last, (self.left, self.low, self.right)):
            top = max(self.low, low + size.imag + PAD)
            if size.real <= right - left and top <= room:
                self.row, self.low = (left + size.real + BETWEEN, low, right, top), top
                return complex(left, low + size.imag)
        return None
