"""Stock rolling bearings: boundary dimensions, load ratings, mass, speed limit.

Boundary dimensions are those of ISO 15 (insert bearings and their flanges: ISO 9628, ISO 3228), equal for all
makers. Load ratings after ISO 281 and ISO 76, masses and speed limits differ between makers by some per cent. The
values here are typical catalogue values of standard series. Speed limits are those of grease lubrication; for insert
bearings those of their seals on a shaft h6.
"""

from dataclasses import dataclass, replace

from ilmek.units import kN, mm, rpm

DEEP_GROOVE, CYLINDRICAL, INSERT = "deep-groove ball", "cylindrical roller", "insert ball"


@dataclass(frozen=True, slots=True)
class RollingBearing:
    """A rolling bearing.

    name    its designation      kind  deep-groove ball, cylindrical roller or insert ball (deep groove inside)
    bore, outer, width           of the rings [m]; an insert bearing's width is the inner ring's
    dynamic, static              load ratings C and C0 [N]
    mass    with the housing [kg]       speed  limit with grease [rad/s]
    flange  side of the square housing of a UCF [m]; 0 without a housing
    pitch, hole, bolt  of the housing's four holes: distance of neighbours, diameter [m], thread of their screws
    """

    name: str
    kind: str
    bore: float
    outer: float
    width: float
    dynamic: float
    static: float
    mass: float
    speed: float
    flange: float = 0.0
    pitch: float = 0.0
    hole: float = 0.0
    bolt: str = ""

    @property
    def standard(self) -> str:
        """What its order states besides its name: seals, standard."""
        if self.kind == INSERT:
            return f", ISO 9628{', cast housing ISO 3228' if self.flange else ''}, with grub screws"
        return "-2RS, DIN 625-1" if self.kind == DEEP_GROOVE else ", DIN 5412-1"


_BALL = """
6000 10 26 8 4.55 1.97 0.019 30000
6001 12 28 8 5.10 2.37 0.022 28000
6002 15 32 9 5.60 2.83 0.030 24000
6003 17 35 10 6.00 3.25 0.039 22000
6004 20 42 12 9.40 5.00 0.069 18000
6005 25 47 12 10.1 5.85 0.080 15000
6006 30 55 13 13.2 8.30 0.116 13000
6007 35 62 14 16.0 10.3 0.155 11000
6008 40 68 15 16.8 11.5 0.192 10000
6009 45 75 16 20.9 15.2 0.245 9000
6010 50 80 16 21.8 16.6 0.261 8500
6011 55 90 18 28.3 21.2 0.385 7500
6012 60 95 18 29.5 23.2 0.410 7100
6014 70 110 20 38.0 31.0 0.600 6000
6016 80 125 22 47.5 40.0 0.850 5300
6018 90 140 24 58.0 49.5 1.16 4500
6020 100 150 24 60.0 54.0 1.25 4300
6200 10 30 9 5.10 2.39 0.032 24000
6201 12 32 10 6.80 3.05 0.037 22000
6202 15 35 11 7.65 3.75 0.045 20000
6203 17 40 12 9.55 4.80 0.066 17000
6204 20 47 14 12.8 6.60 0.106 15000
6205 25 52 15 14.0 7.85 0.128 13000
6206 30 62 16 19.5 11.3 0.200 11000
6207 35 72 17 25.7 15.3 0.288 9500
6208 40 80 18 29.1 17.9 0.366 8500
6209 45 85 19 31.5 20.4 0.407 7500
6210 50 90 20 35.0 23.2 0.463 7100
6211 55 100 21 43.5 29.3 0.607 6300
6212 60 110 22 52.5 36.0 0.780 5600
6214 70 125 24 62.0 44.0 1.07 5000
6216 80 140 26 72.5 53.0 1.40 4500
6218 90 160 30 96.0 71.5 2.15 4000
6220 100 180 34 122 93.0 3.15 3600
6300 10 35 11 8.10 3.45 0.053 22000
6301 12 37 12 9.70 4.20 0.060 20000
6302 15 42 13 11.4 5.45 0.082 17000
6303 17 47 14 13.6 6.65 0.115 15000
6304 20 52 15 15.9 7.90 0.144 14000
6305 25 62 17 20.6 11.2 0.232 11000
6306 30 72 19 26.7 15.0 0.346 9500
6307 35 80 21 33.5 19.2 0.457 8500
6308 40 90 23 40.5 24.0 0.630 7500
6309 45 100 25 53.0 32.0 0.830 6700
6310 50 110 27 62.0 38.5 1.07 6000
6311 55 120 29 71.5 45.0 1.37 5600
6312 60 130 31 82.0 52.0 1.70 5300
6314 70 150 35 104 68.0 2.52 4500
6316 80 170 39 123 86.5 3.60 4000
6318 90 190 43 143 107 4.90 3600
6320 100 215 47 173 141 7.00 3200
"""

_THIN = """
61900 10 22 6 2.70 1.27 0.010 34000
61901 12 24 6 2.91 1.46 0.011 32000
61902 15 28 7 4.36 2.24 0.016 28000
61903 17 30 7 4.62 2.55 0.018 26000
61904 20 37 9 6.37 3.65 0.038 20000
61905 25 42 9 7.02 4.30 0.045 18000
61906 30 47 9 7.28 4.55 0.051 16000
"""

_ROLLER = """
NU204 20 47 14 25.7 22.6 0.110 12000
NU205 25 52 15 29.3 27.7 0.135 10000
NU206 30 62 16 39.0 37.5 0.205 8500
NU207 35 72 17 50.5 50.0 0.300 7500
NU208 40 80 18 55.5 55.5 0.380 7000
NU209 45 85 19 63.0 66.5 0.430 6300
NU210 50 90 20 69.0 76.5 0.490 6000
NU211 55 100 21 86.5 98.5 0.660 5300
NU212 60 110 22 97.5 107 0.820 4800
NU214 70 125 24 119 137 1.15 4300
NU216 80 140 26 139 167 1.50 3800
NU218 90 160 30 182 217 2.30 3400
NU220 100 180 34 249 305 3.40 3000
"""

_INSERT = """
204 20 47 31.0 12.8 6.65 0.17 8500 0.60 86 64 12 M10
205 25 52 34.1 14.0 7.85 0.20 7000 0.80 95 70 12 M10
206 30 62 38.1 19.5 11.3 0.32 6300 1.10 108 83 12 M10
207 35 72 42.9 25.7 15.4 0.48 5300 1.50 117 92 14 M12
208 40 80 49.2 29.1 17.8 0.62 4800 1.90 130 102 16 M14
209 45 85 49.2 32.5 20.4 0.69 4300 2.20 137 105 16 M14
210 50 90 51.6 35.1 23.3 0.80 4000 2.50 143 111 16 M14
211 55 100 55.6 43.4 29.4 1.10 3600 3.30 162 130 19 M16
212 60 110 65.1 52.4 36.2 1.50 3400 4.20 175 143 19 M16
"""


def _bearing(name: str, kind: str, numbers: list[float]) -> RollingBearing:
    bore, outer, width, dynamic, static, mass, speed = numbers
    return RollingBearing(name, kind, bore * mm, outer * mm, width * mm, dynamic * kN, static * kN, mass, speed * rpm)


def _rows(text: str, kind: str) -> list[RollingBearing]:
    lines = (line.split() for line in text.split("\n") if line)
    return [_bearing(name.replace("NU", "NU "), kind, [float(one) for one in rest]) for name, *rest in lines]


def _insert(prefix: str) -> list[RollingBearing]:
    """Insert bearings without a housing (UC), or in a square flanged housing (UCF)."""
    bearings = []
    for name, *rest in (line.split() for line in _INSERT.split("\n") if line):
        *columns, bolt = rest
        *numbers, flanged, side, pitch, hole = (float(column) for column in columns)
        bearing = _bearing(f"{prefix} {name}", INSERT, numbers)
        if prefix == "UCF":
            bearing = replace(bearing, mass=flanged, flange=side * mm, pitch=pitch * mm, hole=hole * mm, bolt=bolt)
        bearings.append(bearing)
    return bearings


ROLLING_BEARINGS: dict[str, RollingBearing] = {
    bearing.name: bearing
    for bearing in (*_rows(_BALL, DEEP_GROOVE), *_rows(_ROLLER, CYLINDRICAL), *_insert("UC"), *_insert("UCF"))
}
"""By designation: 60, 62, 63 deep groove, NU 2 cylindrical roller, UC 2 insert and UCF 2 flanged insert bearings."""

THIN_BEARINGS: dict[str, RollingBearing] = {row.name: row for row in _rows(_THIN, DEEP_GROOVE)}
"""By designation: deep groove bearings 619, for seats of little depth; no choice by load alone takes them."""
