"""Colour: sRGB, linear light, CIE XYZ and CIELAB under D65.

Pictures are sRGB of 8 bits. Light is averaged in linear light; differences are computed in CIELAB
(`colour_difference`).
All functions take arrays whose last axis holds the three components.

Sources: IEC 61966-2-1 (sRGB: transfer curve, primaries and white); CIE 15 (CIELAB).

>>> srgb_to_lab(np.array([255, 255, 255], dtype=np.uint8)).round(9).tolist()
[100.0, 0.0, 0.0]
"""

import numpy as np

from ilmek.arrays import Float, FloatArray, RealField, UInt8

Components = Float[np.ndarray, "*batch 3"]

WHITE = np.array([0.3127 / 0.3290, 1.0, (1 - 0.3127 - 0.3290) / 0.3290])
"""XYZ of the sRGB white (D65 by its chromaticity x = 0.3127, y = 0.3290)."""


def _primaries_to_xyz() -> FloatArray:
    """The matrix linear sRGB -> XYZ: columns are the primaries, scaled so that (1, 1, 1) is the white."""
    x, y = np.array([0.64, 0.30, 0.15]), np.array([0.33, 0.60, 0.06])
    columns = np.stack([x / y, np.ones(3), (1 - x - y) / y])
    return np.asarray(columns * np.linalg.solve(columns, WHITE))


RGB_TO_XYZ = _primaries_to_xyz()
XYZ_TO_RGB = np.linalg.inv(RGB_TO_XYZ)

_EPSILON, _KAPPA = 216 / 24389, 24389 / 27


def decode(encoded: RealField) -> FloatArray:
    """Linear light of encoded sRGB, both 0 to 1:  v/12.92  or  ((v + 0.055)/1.055)^2.4   [IEC 61966-2-1, 5.2]."""
    v = np.asarray(encoded, dtype=float)
    return np.where(v <= 0.04045, v / 12.92, ((np.maximum(v, 0.04045) + 0.055) / 1.055) ** 2.4)


def encode(linear: RealField) -> FloatArray:
    """Encoded sRGB of linear light, both 0 to 1: the inverse of `decode`."""
    v = np.asarray(linear, dtype=float)
    return np.where(v <= 0.04045 / 12.92, v * 12.92, 1.055 * np.maximum(v, 0.003) ** (1 / 2.4) - 0.055)


LINEAR = decode(np.arange(256) / 255)
"""Linear light of each of the 256 codes of a channel."""


def xyz_to_lab(xyz: Components) -> Components:
    """CIELAB of XYZ (white Y = 1)   [CIE 15, 8.2.1]:

        L = 116 f(Y) - 16,   a = 500 (f(X) - f(Y)),   b = 200 (f(Y) - f(Z))

    f is the cube root, and a straight line below (6/29)^3.
    """
    t = xyz / WHITE
    f = np.where(t > _EPSILON, np.cbrt(t), (_KAPPA * t + 16) / 116)
    x, y, z = f[..., 0], f[..., 1], f[..., 2]
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def lab_to_xyz(lab: Components) -> Components:
    """XYZ (white Y = 1) of CIELAB: the inverse of `xyz_to_lab`."""
    y = (lab[..., 0] + 16) / 116
    f = np.stack([y + lab[..., 1] / 500, y, y - lab[..., 2] / 200], axis=-1)
    return np.asarray(WHITE * np.where(f > 6 / 29, f**3, (116 * f - 16) / _KAPPA))


def srgb_to_lab(rgb: UInt8[np.ndarray, "*batch 3"]) -> Components:
    """CIELAB of sRGB codes 0 to 255."""
    linear: FloatArray = LINEAR[rgb]
    return xyz_to_lab(linear @ RGB_TO_XYZ.T)


def lab_to_srgb(lab: Components) -> UInt8[np.ndarray, "*batch 3"]:
    """The nearest sRGB codes of CIELAB; each channel outside sRGB is clipped."""
    linear: FloatArray = np.clip(lab_to_xyz(lab) @ XYZ_TO_RGB.T, 0.0, 1.0)
    codes: UInt8[np.ndarray, "*batch 3"] = np.rint(255 * encode(linear)).astype(np.uint8)
    return codes


def takes_white(srgb: tuple[int, int, int]) -> bool:
    """Whether white letters have more contrast with a colour than black ones: its relative luminance is below 0.179.

    Black and white contrast equally at that luminance   [WCAG 2.2, 1.4.3].

    >>> takes_white((158, 43, 37)), takes_white((239, 230, 208))
    (True, False)
    """
    return float(LINEAR[list(srgb)] @ np.array([0.2126, 0.7152, 0.0722])) < 0.179
