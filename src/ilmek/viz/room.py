"""A carpet in a room: a floor of boards in perspective, a wall with its skirting, a settee, light from a window.

The camera looks straight at the wall, its picture plane upright, so that upright lines stay upright. With x to the
right, y away from the camera, z up, and the camera at (0, -c, h) [m], a pixel (u, v) looks along (u, 1, v):

    floor: y = -h/v - c, x = u (y + c),      wall at y = D: x = u (D + c), z = h + v (D + c)

Each pixel of the floor reads the picture of the carpet where its ray meets it: the homography of the carpet's plane.
"""

from collections.abc import Iterator
from functools import lru_cache

import numpy as np
from PIL import Image, ImageDraw, ImageFilter, ImageOps

from ilmek.arrays import BoolArray, FloatArray, Rgb
from ilmek.records import record

WIDE, HIGH = 1200, 800
"""Size of the picture [pixels]."""

_FINER = 2
"""Rays along each side of a pixel."""

_EYE, _GAP, _SETTEE = 1.8, 0.35, (1.9, 0.85, 0.42, 0.82)
"""Height of the camera; floor before and behind the carpet; width, depth, seat and height of the settee [m]."""

_SKIRTING, _BOARD, _SHADOW = 0.09, 0.14, 0.03
_WHITE = 247
"""Code below which a picture shows a carpet and not its white paper."""

_WALL, _TRIM, _CLOTH, _SHADE = (232, 228, 219), (248, 246, 241), (122, 134, 142), (50, 38, 26)
_OAK = np.array((181, 140, 98), np.float32)


@record
class _Camera:
    """Distances c from the near edge of the floor and D to the wall [m]; half width a and upper edge v of a picture."""

    near: float
    wall: float
    half: float
    upper: float

    @property
    def lower(self) -> float:
        return self.upper - 2 * self.half * HIGH / WIDE

    def pixel(self, x: float, y: float, z: float) -> tuple[float, float]:
        """Where a point is seen, in rays."""
        scale = _FINER * WIDE / (2 * self.half)
        return scale * (x / (y + self.near) + self.half), scale * (self.upper - (z - _EYE) / (y + self.near))


def draw_room(carpet: Image.Image, width: float, length: float) -> Image.Image:
    """The picture of a room with a carpet on its floor.

    carpet  its picture, upright on white, which is seen as floor      width, length  of what it shows [m]
    """
    bare = _bare_room(width, length)
    image = Image.fromarray(np.concatenate((bare.wall, _floor(bare, carpet, (width, length)))))
    _draw_settee(ImageDraw.Draw(image, "RGBA"), bare.camera)
    return image.reduce(_FINER)


@record
class _BareRoom:
    """A room without its carpet: wall, floor, and of the rays to the floor where they meet it [m], boards and light."""

    camera: _Camera
    wall: Rgb
    floor: Rgb
    x: FloatArray
    y: FloatArray
    boards: FloatArray
    light: FloatArray


@lru_cache(maxsize=1)  # the colourways of a design lie in one room
def _bare_room(width: float, length: float) -> _BareRoom:
    camera = _camera(width, length)
    rows, columns = _FINER * HIGH, _FINER * WIDE
    u = camera.half * (2 * (np.arange(columns) + 0.5) / columns - 1)
    v = camera.upper - (camera.upper - camera.lower) * (np.arange(rows) + 0.5) / rows
    horizon = int(np.count_nonzero(v > -_EYE / (camera.wall + camera.near)))
    y = -_EYE / v[horizon:, np.newaxis] - camera.near
    x = u * (y + camera.near)
    boards, light = _boards(x, y), _daylight(x, y, camera)
    floor = _codes(_OAK * (boards * light)[..., np.newaxis])
    return _BareRoom(camera, _wall(camera, u, v[:horizon]), floor, x, y, boards, light)


def _camera(width: float, length: float) -> _Camera:
    wall = 2 * _GAP + length + _SETTEE[1] + 0.05
    near = max(1.5, 0.7 * length, 0.8 * width)
    lower = -_EYE / (near + 0.4 * _GAP)
    seen = max(0.62 * width / (near + _GAP), WIDE / (2 * HIGH) * (0.25 / (wall + near) - lower))
    return _Camera(near, wall, seen, lower + 2 * seen * HIGH / WIDE)


def _wall(camera: _Camera, u: FloatArray, v: FloatArray) -> Rgb:
    x, z = u * (camera.wall + camera.near), _EYE + v[:, np.newaxis] * (camera.wall + camera.near)
    light = 1.03 - 0.10 * (x - x[0]) / (x[-1] - x[0]) - 0.05 * np.exp(-z / 0.25)
    trim = (z < _SKIRTING)[..., np.newaxis]
    edge = 1.0 - 0.14 * (np.abs(z - _SKIRTING) < 0.006)
    return _codes(np.where(trim, _TRIM, _WALL) * (light * edge)[..., np.newaxis])


def _boards(x: FloatArray, y: FloatArray) -> FloatArray:
    """Brightness of the boards: each has a tone, grain and seams."""
    board = np.floor(x / _BOARD)
    tone = np.sin(12.9898 * board) * 43758.5453
    joint = np.floor((y + 1.7 * (tone - np.floor(tone))) / 1.6)
    shade = np.sin(78.233 * board + 37.719 * joint) * 43758.5453
    grain = 1.0 + 0.09 * ((shade - np.floor(shade)) - 0.5) + 0.015 * np.sin(210 * x + 3 * np.sin(2.1 * y + board))
    seams = 1.0 - 0.22 * (np.abs(x / _BOARD - np.round(x / _BOARD)) * _BOARD < 0.0016)
    boards: FloatArray = grain * seams
    return boards


def _floor(bare: _BareRoom, carpet: Image.Image, size: tuple[float, float]) -> Rgb:
    (width, length), x, y = size, bare.x, bare.y
    texels = _framed(carpet, width)
    high, wide = texels.shape[:2]
    scale = carpet.width / width
    across = (x + width / 2) * scale + (wide - carpet.width) / 2 - 0.5
    down = np.broadcast_to((_GAP + length - y) * scale + (high - carpet.height) / 2 - 0.5, x.shape)
    inside = (across > 0) & (across < wide - 1) & (down > 0) & (down < high - 1)
    seen = _read(texels, across[inside], down[inside])
    there = np.flatnonzero(inside)
    boards, light = bare.boards.reshape(-1)[there], bare.light.reshape(-1)[there]
    shown = _OAK * (boards * (1.0 - 0.40 * seen[:, 3] / 255) * light)[:, np.newaxis]
    pile = _coloured(seen)
    shown[pile] = seen[pile, :3] * light[pile, np.newaxis]
    floor = bare.floor.copy()
    floor.reshape(-1, 3)[there] = _codes(shown)
    return floor


def _framed(carpet: Image.Image, width: float) -> Rgb:
    """The picture of the carpet with a margin, and as a fourth colour the shadow that it casts beside it."""
    blur = max(1.0, _SHADOW * carpet.width / width)
    framed = ImageOps.expand(carpet.convert("RGB"), round(3 * blur), (255, 255, 255))
    shadow = Image.fromarray(255 * _coloured(np.asarray(framed)).astype(np.uint8))
    shadow = shadow.filter(ImageFilter.GaussianBlur(blur))
    return np.dstack((np.asarray(framed), np.asarray(shadow)))


def _daylight(x: FloatArray, y: FloatArray, camera: _Camera) -> FloatArray:
    """Light falls from a window on the left, and lies as two bright fields on the floor."""
    fall = 1.05 - 0.16 * (x / camera.wall + 0.5) - 0.10 * np.exp(-(camera.wall - y) / 0.5)
    slant = np.abs(np.abs(x + 0.55 * y - 0.25 * camera.wall) - 0.5)
    field = _edge(0.42 - slant) * _edge(y - 0.45) * _edge(camera.wall - 0.8 - y)
    light: FloatArray = fall * (1.0 + 0.09 * field)
    return light


def _edge(inside: FloatArray) -> FloatArray:
    """1 inside, 0 outside, with an edge that is soft as that of a window's light."""
    edge: FloatArray = 1.0 / (1.0 + np.exp(-np.clip(inside / 0.025, -40, 40)))
    return edge


def _coloured(picture: Rgb) -> BoolArray:
    """Where a picture is not white paper; the last axis are its colours."""
    paper: BoolArray = (picture[..., 0] >= _WHITE) & (picture[..., 1] >= _WHITE) & (picture[..., 2] >= _WHITE)
    return ~paper


def _read(texels: Rgb, across: FloatArray, down: FloatArray) -> FloatArray:
    """The picture between its pixels, bilinear; its four colours are read as one number."""
    column, row = across.astype(np.intp), down.astype(np.intp)
    right, low = (part.astype(np.float32)[:, np.newaxis] for part in (across - column, down - row))
    wide, packed = texels.shape[1], texels.view(np.uint32).ravel()
    at = row * wide + column
    near, aside, below, over = (packed[at + step].view(np.uint8).reshape(-1, 4) for step in (0, 1, wide, wide + 1))
    between: FloatArray = (near * (1 - right) + aside * right) * (1 - low) + (below * (1 - right) + over * right) * low
    return between


def _draw_settee(draw: ImageDraw.ImageDraw, camera: _Camera) -> None:
    """The settee at the wall, its boxes from behind to the front."""
    width, depth, seat, high = _SETTEE
    front, back, half = camera.wall - depth, camera.wall - 0.02, width / 2
    for step in range(9):
        edges = (-half - 0.05 + 0.01 * step, half + 0.05 - 0.01 * step), (front - 0.10 + 0.012 * step, back)
        draw.polygon([camera.pixel(*point) for point in _corners(*edges, 0.0)], fill=(*_SHADE, 26))
    boxes = [((-half, half), (back - 0.2, back), (0.1, high))]
    boxes += [((side * half - 0.09, side * half + 0.09), (front + 0.04, back), (0.08, 0.62)) for side in (-1, 1)]
    boxes += [((low, low + half - 0.1), (front, back - 0.2), (0.1, seat)) for low in (-half + 0.1, 0.0)]
    for x, y, z in boxes:
        for shade, face in _faces(x, y, z):
            points = [camera.pixel(*point) for point in face]
            draw.polygon(points, fill=_shaded(shade), outline=_shaded(shade - 0.12))


def _faces(
    x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]
) -> Iterator[tuple[float, list[tuple[float, float, float]]]]:
    """The faces of a box that the camera sees, with their brightness."""
    side = x[1] if x[1] < 0 else x[0] if x[0] > 0 else None
    if side is not None:
        yield 0.75, [(side, y[0], z[0]), (side, y[1], z[0]), (side, y[1], z[1]), (side, y[0], z[1])]
    yield 1.08, _corners(x, y, z[1])
    yield 0.92, [(x[0], y[0], z[0]), (x[1], y[0], z[0]), (x[1], y[0], z[1]), (x[0], y[0], z[1])]


def _corners(x: tuple[float, float], y: tuple[float, float], z: float) -> list[tuple[float, float, float]]:
    return [(x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z)]


def _shaded(shade: float) -> tuple[int, int, int]:
    red, green, blue = (min(255, round(code * shade)) for code in _CLOTH)
    return red, green, blue


def _codes(colours: FloatArray) -> Rgb:
    codes: Rgb = np.clip(colours, 0, 255).astype(np.uint8)
    return codes
