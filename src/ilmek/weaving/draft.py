"""A weaving draft: which warps each pick has above it, by threading, tie-up and treadling, or by a lift plan.

warp e is up in pick p  <=>  a shaft of e is lifted in p      (of a sinking shed: no shaft of e is pulled down in p)
"""

import numpy as np

from ilmek.arrays import BoolArray, Rgb
from ilmek.records import JsonObject, record


@record
class Draft:
    """A draft, as a loom with shafts weaves it.

    up      warps above each pick (picks, warps), pick 0 first     shafts, treadles  of the loom; 0: a lift plan
    warp    colour of each warp, weft of each pick, sRGB (n, 3)
    warp_pitch, weft_pitch  distance of two warps and of two picks [m]; None: the file does not say
    """

    up: BoolArray
    shafts: int
    treadles: int
    warp: Rgb
    weft: Rgb
    warp_pitch: float | None = None
    weft_pitch: float | None = None

    @property
    def face(self) -> Rgb:
        """The colour that is seen at each crossing (picks, warps, 3).

        >>> over = Draft(np.eye(2, dtype=bool), 2, 2, np.zeros((2, 3), np.uint8), np.full((2, 3), 255, np.uint8))
        >>> over.face[..., 0].tolist()
        [[0, 255], [255, 0]]
        """
        seen: Rgb = np.where(self.up[..., np.newaxis], self.warp[np.newaxis], self.weft[:, np.newaxis])
        return seen

    @property
    def is_plain(self) -> bool:
        """Whether neighbouring crossings are unlike everywhere: plain weave."""
        return bool((self.up[1:] != self.up[:-1]).all() and (self.up[:, 1:] != self.up[:, :-1]).all())

    @property
    def warp_float(self) -> int:
        """Most picks in succession over which a warp lies."""
        return _longest(self.up.T)

    @property
    def weft_float(self) -> int:
        """Most warps in succession over which a pick lies."""
        return _longest(~self.up)

    def as_json(self) -> JsonObject:
        """What it is, SI."""
        picks, warps = self.up.shape
        return {
            "warps": warps,
            "picks": picks,
            "shafts": self.shafts,
            "treadles": self.treadles,
            "warp_pitch": self.warp_pitch,
            "weft_pitch": self.weft_pitch,
            "plain": self.is_plain,
            "warp_float": self.warp_float,
            "weft_float": self.weft_float,
            "colours": [{"srgb": name, "warps": ends, "picks": ways} for name, ends, ways in self.colours],
            "up": ["".join(line) for line in np.where(self.up, "1", "0").tolist()],
        }

    @property
    def colours(self) -> list[tuple[str, int, int]]:
        """Each colour, as #rrggbb, with its warps and picks; the most frequent first."""
        names, warps = np.unique(np.concatenate((self.warp, self.weft)), axis=0), len(self.warp)
        found = []
        for name in names:
            same = (np.concatenate((self.warp, self.weft)) == name).all(axis=1)
            found.append((f"#{bytes(name.tolist()).hex()}", int(same[:warps].sum()), int(same[warps:].sum())))
        return sorted(found, key=lambda one: -(one[1] + one[2]))


def _longest(lines: BoolArray) -> int:
    """Longest run of true values along the last axis.

    >>> _longest(np.array([[True, True, False, True]]))
    2
    """
    padded = np.pad(lines, ((0, 0), (1, 1))).astype(np.int8)
    edges = np.diff(padded, axis=1).ravel()
    begins, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return int((ends - begins).max(initial=0))
