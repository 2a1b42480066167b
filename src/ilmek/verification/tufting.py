"""The tufting paper: ranges, stroke, crank angles, times, and its statements on torques and forces."""

from functools import cache, partial

from scipy.optimize import brentq

from ilmek.machines.tufting import Tufting, TuftingParams, design
from ilmek.units import deg, mm, rpm, turn
from ilmek.verification import tufting_equations, tufting_systems
from ilmek.verification.claim import OFF, UNSOUND, Claim

TEXT = "Dynamic analysis"
_claim = partial(Claim, "tufting")


def claims() -> tuple[Claim, ...]:
    """All computable claims of the paper."""
    return (
        *tufting_equations.claims(),
        *tufting_systems.claims(),
        *_ranges(),
        *_needle(),
        *_times(),
        *_torques(),
        *_unsettled(),
    )


@cache
def _made(**settings: str) -> Tufting:
    return design(TuftingParams.read(settings))


def _ranges() -> tuple[Claim, ...]:
    """Angles of the links over a turn."""
    printed = {"2": ("101.7", "114.3"), "3": ("184.3", "199.4"), "4": ("-7.89", "7.38"), "5": ("257.9", "258.5")}
    note = {("4", 0): "θ3 - 192° = -7.68°; the paper's own 184.3° gives -7.7°"}

    def end(link: str, index: int) -> float:
        return _made().ranges[f"theta{link}"][index] / deg

    return tuple(
        _claim(f"{side} θ{link}", text, "deg", partial(end, link, index), f"{TEXT}, Fig 7", note.get((link, index), ""))
        for link, texts in printed.items()
        for index, (side, text) in enumerate(zip(("least", "greatest"), texts, strict=True))
    )


def _needle() -> tuple[Claim, ...]:
    """The needle's stroke and crank angles."""
    flat = "a reading: crank and coupler are in line at the computed angle; within a degree the needle moves 3 µm"
    backing = "backing at half of the stroke"
    return (
        _claim("stroke of the needle, 'about'", "33", "mm", lambda: _made().stroke / mm, TEXT),
        _claim("crank angle of the lowest point", "108", "deg", lambda: _made().lowest / deg, TEXT, flat, missed=OFF),
        _claim(
            "crank angle from which the needle rises",
            "109",
            "deg",
            lambda: _made().lowest / deg,
            TEXT,
            flat,
            missed=OFF,
        ),
        _claim("crank angle of the highest point", "287", "deg", lambda: _made().highest / deg, TEXT, flat, missed=OFF),
        _claim("entry", "22", "deg", partial(_half_way, 5, 60), TEXT, fitted=backing),
        _claim("exit", "194", "deg", partial(_half_way, 150, 230), TEXT, fitted=backing),
    )


def _half_way(low: float, high: float) -> float:
    """Crank angle [deg] between two at which the needle is half its stroke above its lowest point."""
    found = _made()
    return float(brentq(lambda at: found.height(at) - found.stroke / 2, low * deg, high * deg, xtol=1e-12)) / deg


def _times() -> tuple[Claim, ...]:
    """Experiment: one turn at 160 rpm, which ends at 14.375 s."""
    period = turn / (160 * rpm)

    def at(angle: float) -> float:
        return 14.375 - period + angle * deg / (160 * rpm)

    times = {"22": "14.02", "108": "14.11", "194": "14.20", "287": "14.30"}
    anchored = "360° at 14.375 s"
    return (
        _claim("time of a turn", "0.375", "s", lambda: period, "Experiment"),
        *(
            _claim(f"time of {angle}°", text, "s", partial(at, float(angle)), "Experiment, Fig 9", fitted=anchored)
            for angle, text in times.items()
        ),
    )


def _torques() -> tuple[Claim, ...]:
    """Driven shaft against main shaft: peaks, with all loads and of inertia alone."""
    still = {"gravity": "0m/s^2", "friction_force": "0N"}

    def ratio(over: str, under: str, settings: dict[str, str]) -> float:
        peaks = _made(**settings).peaks
        return peaks[over].value / peaks[under].value

    torques = "driven_torque", "main_torque"
    return (
        _claim("torque of driven shaft by main shaft, 'far greater'", "> 1", "", partial(ratio, *torques, {}), TEXT),
        _claim(
            "inertia torque of driven shaft by main shaft", "> 1", "", partial(ratio, *torques, still), "Conclusions"
        ),
        _claim(
            "force on driven shaft by main shaft", "> 1", "", partial(ratio, "C", "O", {}), "Conclusions, all loads"
        ),
        _claim(
            "force of inertia on driven shaft by main shaft, without friction and weight",
            "> 1",
            "",
            partial(ratio, "C", "O", still),
            "Conclusions",
            "with friction it holds; inertia alone loads the main shaft's bearing more: 47 N against 30 N at 160 rpm",
            missed=UNSOUND,
        ),
    )


def _unsettled() -> tuple[Claim, ...]:
    drawn = "curves without numbers"
    return (
        _claim(
            "where the friction of 1000 N acts",
            "on and under the backing",
            "N",
            lambda: None,
            TEXT,
            "two readings, from entry to exit or always: ilmek design tufting has both, with the same peaks",
        ),
        _claim(
            "moments of inertia of l1 to l6",
            "data",
            "",
            lambda: None,
            "Table 1",
            "the shapes are not printed; bars of these masses and lengths would have 0.06, 6.0, 3.3, 2.3, 0.4, 23.7",
        ),
        _claim("Eq 19, acceleration of the needle", "lost", "", lambda: None, "Eq 19", "not in the scanned text"),
        _claim("velocity and acceleration of the needle", "curve", "m/s", lambda: None, "Fig 7", drawn),
        _claim("forces in the joints", "curve", "N", lambda: None, "Fig 8", drawn),
        _claim(
            "measured torque",
            "curve",
            "N m",
            lambda: None,
            "Fig 9",
            "no data; the friction force was chosen by experience",
        ),
    )
