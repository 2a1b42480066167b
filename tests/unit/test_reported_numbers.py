"""Numbers that only a report, a parts list or a drawing holds, each against an oracle of its own."""

import math
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
from default_machines import default_report

from ilmek.cams.laws import LAWS
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import CamProgramme, fall, rise
from ilmek.elements.bearings import equivalent_load, find_bearing
from ilmek.elements.screws import trapezoidal
from ilmek.errors import ParameterError
from ilmek.io.dxf import write_dxf
from ilmek.machines import ENTRIES
from ilmek.machines.catalogue import find_machine
from ilmek.machines.hammer import HammerParams
from ilmek.machines.knotting_dyad import KnottingDyadParams
from ilmek.machines.knotting_dyad.motion import drive_angles
from ilmek.params import declared
from ilmek.plane.contours import circle
from ilmek.report import Plate, Report
from ilmek.units import mm, turn


@cache
def report(machine: str, **settings: str) -> Report:
    made = find_machine(machine)
    return made.report(made.design(made.params.read(settings))) if settings else default_report(machine)


def results(machine: str, **settings: str) -> dict[str, Any]:
    found = report(machine, **settings).as_json()["results"]
    assert isinstance(found, dict)
    return found


def number_of(part: str) -> int:
    """How many of a part the loom's parts list has."""
    table = next(table for table in report("automated-loom").tables if table.name == "loom-parts")
    return next(row[1] for row in table.rows if row[0] == part)


def energy(share: str) -> float:
    """Energy of the loom's whole carpet that goes to one of its acts [J]: its mean power over the weaving time."""
    found = results("automated-loom", weft="shuttle")
    return found["power_shares"][share] * found["energy"] / found["power_mean"]


def shuttle_passages() -> float:
    """Two passages and an empty run a row: energy of motion at the greatest speed, found by differences, and drag."""
    loom = find_machine("automated-loom")
    made = loom.design(loom.params.read({"weft": "shuttle"}))
    weft, passage = made.weft, made.weft.passage
    time = np.linspace(0.0, passage.time, 200_001)
    speed = np.gradient(passage.at(time)[0], time[1])
    moved = weft.axis.mass * speed.max() ** 2 + 0.5 * (weft.axis.mass - weft.carried.full) * speed.max() ** 2
    dragged = 2 * weft.resisting / weft.params.belt_efficiency * np.trapezoid(speed, time)
    return made.rows * (moved + dragged) / made.params.drive_efficiency


def hertz_limit() -> float:
    """The pressure goes with the root of the force, the force with 1 / T²: T shrinks as the pressure grows."""
    found = report("weaver").as_json()["results"]
    limit = next(check.limit for check in report("weaver").checks if check.name.startswith("Hertz pressure"))
    return found["cycle_time_knot"] * max(found["cam_hertz_max"].values()) / limit


STRETCHED = {"half_span": "300mm", "warp_length": "600mm", "cloth.yarns.warp_stiffness": "1800N"}


def strained(compensation: float) -> float:
    """Tension of a warp whose cylinder gives way by a share of its lengthening: the rest strains it."""
    found = results("shedding", **STRETCHED)
    return 15.0 + (1 - compensation) * 1800.0 * found["warp_strain"]


def harmonic_torque(warps: int) -> float:
    """n F h / 2 * pi / beta of the cams that rise together: 10 N, 60 mm in 90°."""
    return warps * 10.0 * 0.03 * 2.0


NUMBERS: dict[str, tuple[Callable[[], float], Callable[[], float]]] = {
    "energy of the shuttle": (lambda: energy("shuttle"), shuttle_passages),
    "energy of what stands by": (
        lambda: results("automated-loom")["power_shares"]["standing by"],
        lambda: 10.0 * number_of("axis of the control"),
    ),
    "power in all": (
        lambda: results("automated-loom")["power_mean"],
        lambda: sum(results("automated-loom")["power_shares"].values()),
    ),
    **{
        f"bearings of the {cylinder} cylinder": (
            lambda one=cylinder: number_of(f"bearing of the {one} cylinder"),
            # the parts list has one bearing for each end that a reaction acts on
            lambda one=cylinder: (
                results("warp-tension")["cylinder_load"][one]
                * find_machine("warp-tension").params().span
                / results("warp-tension")["cylinder_reaction"][one]
            ),
        )
        for cylinder in ("upper", "lower", "spacer")
    },
    "cycle limit by Hertz pressure": (lambda: results("weaver")["cycle_limits"]["cams"], hertz_limit),
    **{
        f"tension with a compensation of {share}": (
            lambda share=share: results("shedding", compensation=str(share), **STRETCHED)["warp_tension_max"],
            lambda share=share: strained(share),
        )
        for share in (0.0, 0.4, 1.0)
    },
    **{
        f"torque of {warps} warps": (
            lambda warps=warps: results("shedding", **{"cloth.warps": str(warps)})["shaft_torque_max"],
            lambda warps=warps: harmonic_torque(math.ceil(warps / 2)),
        )
        for warps in (2, 7, 8)
    },
    **{
        # ISO 2904, table of the basic sizes: core diameter d3 of the screw
        f"core diameter of Tr {nominal}": (
            lambda nominal=nominal: trapezoidal(nominal * mm).core / mm,
            lambda core=core: core,
        )
        for nominal, core in (
            (8, 6.2),
            (10, 7.5),
            (12, 8.5),
            (16, 11.5),
            (20, 15.5),
            (24, 18.5),
            (28, 22.5),
            (32, 25.0),
        )
    },
}


@pytest.mark.parametrize("name", NUMBERS)
def test_a_reported_number_is_that_of_its_oracle(name: str) -> None:
    reported, expected = NUMBERS[name]
    assert reported() == pytest.approx(expected(), rel=1e-6)


def test_an_axial_load_never_makes_the_equivalent_load_less_than_the_radial_load() -> None:
    """Fa / C0 = 0.014, Fa / Fr = 0.1901: just above e = 0.19, where 0.56 Fr + 2.30 Fa = 0.997 Fr [Shigley, 11-1]."""
    bearing = find_bearing("6206")
    axial = 0.014 * bearing.static
    radial = axial / 0.1901
    assert equivalent_load(bearing, radial, axial) == radial
    assert equivalent_load(bearing, axial, axial) == pytest.approx((0.56 + 2.30) * axial)


def test_plates_and_cam_tables_of_the_shedding_fit_the_shaft_and_its_turn() -> None:
    """Every plate has a square hole for the shaft's bar; the even and the odd table take a turn at 5 rpm."""
    found = report("shedding")
    # Brackets are of its stand; the rings that press the cams stand on the thread.
    on_shaft = [plate for plate in found.plates if not plate.name.endswith(("bracket", "pressure-ring"))]
    assert len(on_shaft) > 3
    for plate in on_shaft:
        (corners,) = (cut.points for cut in plate.cutouts)
        sides = np.roll(corners, -1) - corners
        np.testing.assert_allclose(np.abs(sides), results("shedding")["shaft_bar"], rtol=1e-12)
        np.testing.assert_allclose(sides[1:], 1j * sides[:-1], rtol=1e-12)
        assert abs(corners.mean()) < 1e-15
    assert [table.period for table in found.cam_tables] == pytest.approx([12.0, 12.0])


@pytest.mark.parametrize(("drive", "share"), [("comb", 0.0), ("linkage", 0.5)])
def test_the_supports_of_a_comb_stand_at_its_ends_and_those_on_crank_rockers_in_their_shares(
    drive: str, share: float
) -> None:
    params = find_machine("hammer").params.read({"drive": drive, "supports": "3"})
    assert isinstance(params, HammerParams)
    assert params.inset == pytest.approx(share * params.cloth.width / 3)


@pytest.mark.parametrize(("drive", "expected"), [("belt", (0.7, 1.9)), ("direct", (0.7, 1.2))])
def test_the_drives_of_an_arm_turn_by_the_links_angles_or_the_elbows(drive: str, expected: tuple[float, float]) -> None:
    params = find_machine("knotting-dyad").params.read({"elbow_drive": drive})
    assert isinstance(params, KnottingDyadParams)
    assert tuple(np.array([0.7, 1.9]) @ drive_angles(params).T) == pytest.approx(expected)


def test_a_bored_plate_without_holes_has_a_cross_at_its_centre(tmp_path: Path) -> None:
    cam = PlateCam(CamProgramme((rise(3.0, 0.02, LAWS["cycloidal"]), fall(turn - 3.0, 0.02, LAWS["cycloidal"]))), 0.05)
    outline = cam.surface(-np.arange(720) * turn / 720)
    write_dxf(tmp_path / "cam.dxf", Plate("cam", "Plate cam", outline, 0.01, "steel", cutouts=(circle(0j, 0.01),)))
    lines = list(ezdxf.readfile(tmp_path / "cam.dxf").modelspace().query('LINE[layer=="CENTRE"]'))
    assert len(lines) == 2
    for line in lines:
        middle = line.dxf.start + line.dxf.end
        assert (middle.x, middle.y) == pytest.approx((0.0, 0.0), abs=1e-9)


@pytest.mark.parametrize("machine", ENTRIES)
def test_a_bound_is_within_or_without_as_it_is_declared(machine: str) -> None:
    for parameter in declared(find_machine(machine).params):
        whole = parameter.kind is int
        for bound, sign, included in (
            (parameter.at_least, -1, True),
            (parameter.at_most, 1, True),
            (parameter.above, -1, False),
            (parameter.below, 1, False),
        ):
            if bound is None:
                continue
            beyond = bound + sign * (1 if whole else 1e-6 * max(abs(bound), 1e-6))
            inside = bound if included else bound - sign * (1 if whole else 1e-6 * max(abs(bound), 1e-6))
            parameter.check(inside)
            for outside in (beyond,) if included else (bound, beyond):
                with pytest.raises(ParameterError):
                    parameter.check(outside)
