"""The sweep over many cams equals each of them designed alone."""

import math

import numpy as np
import pytest
from benchmarks.cam_sweep import requirements, sweep

from ilmek.cams import limits
from ilmek.cams.contact import FollowerLoad
from ilmek.cams.laws import LAWS
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.cams.sizing import CamLimits, pressure_prime
from ilmek.errors import ParameterError
from ilmek.num.piecewise import supremum
from ilmek.units import deg

NAMES = list(LAWS)


@pytest.fixture(scope="module")
def designs():
    rng = np.random.default_rng(7)
    count = 3 * len(NAMES)
    return requirements(
        count,
        law=np.arange(count) % len(NAMES),
        lift=rng.uniform(0.005, 0.08, count),
        rise=rng.uniform(50 * deg, 170 * deg, count),
        fall=rng.uniform(60 * deg, 185 * deg, count),
        limit=rng.uniform(20 * deg, 45 * deg, count),
        offset=rng.uniform(-0.001, 0.001, count),
        roller_radius=rng.uniform(0.0, 0.001, count),
        mass=rng.uniform(0.0, 2.0, count),
        speed=rng.uniform(5.0, 40.0, count),
        rate=rng.uniform(0.0, 3000.0, count),
        preload=rng.uniform(0.0, 90.0, count),
        load=rng.uniform(0.0, 90.0, count),
    )


def alone(designs, i: int) -> tuple[PlateCam, float]:
    """The single design, and its largest torque."""
    law, lift = LAWS[NAMES[designs.law[i]]], float(designs.lift[i])
    up, down = float(designs.rise[i]), float(designs.fall[i])
    programme = CamProgramme((rise(up, lift, law), fall(down, lift, law), dwell(TURN - up - down)))
    offset = float(designs.offset[i])
    prime = pressure_prime(programme, CamLimits(rise=float(designs.limit[i])), offset).value
    held = FollowerLoad(*(float(getattr(designs, name)[i]) for name in ("speed", "mass", "rate", "preload", "load")))

    def torque(angle):
        at = programme.at(angle)
        return np.abs(held.force(at.s, at.dds) * at.ds)

    return PlateCam(programme, prime, offset, float(designs.roller_radius[i])), supremum(torque, programme.knots).value


def test_sweep_equals_each_design_alone(designs) -> None:
    found = sweep([LAWS[name] for name in NAMES], designs)
    for i in range(designs.law.size):
        cam, torque = alone(designs, i)
        assert found.prime_radius[i] == pytest.approx(cam.prime_radius, rel=1e-10)
        pressed = limits.pressure_angle_max(cam, "rise").value
        assert found.pressure_angle_max[i] == pytest.approx(pressed, rel=1e-9)
        assert found.curvature_radius_min[i] == pytest.approx(limits.convex_radius_min(cam).value, rel=1e-8)
        assert found.undercut[i] == limits.undercut(cam)
        assert found.area[i] == pytest.approx(limits.area(cam), rel=1e-9)
        assert found.torque_max[i] == pytest.approx(torque, rel=1e-9)


def test_shedding_cam_among_ten_thousand() -> None:
    lifts = np.linspace(0.02, 0.1, 10_000)
    lifts[5000] = 0.06
    found = sweep([LAWS["harmonic"]], requirements(10_000, law=0, lift=lifts, rise=math.pi / 2, limit=30 * deg))
    assert found.prime_radius[5000] == pytest.approx(0.03 * (math.sqrt(13) - 1), rel=1e-9)
    assert found.curvature_radius_min[5000] == pytest.approx(0.07394448725, rel=1e-8)
    # All cams of one law, angle and limit are similar.
    assert found.area / lifts**2 == pytest.approx(np.full(10_000, found.area[5000] / 0.06**2), rel=1e-9)


def test_roller_that_fills_the_prime_circle_is_undercut() -> None:
    found = sweep([LAWS["cycloidal"]], requirements(1, law=0, lift=0.01, rise=1.5, limit=0.5, roller_radius=0.05))
    assert found.undercut.all()
    assert np.isnan(found.area).all()


@pytest.mark.parametrize("bad", [dict(rise=4.0, fall=3.0), dict(rise=1.0, limit=2.0)])
def test_designs_that_cannot_be_are_refused(bad) -> None:
    with pytest.raises(ParameterError):
        requirements(3, **({"law": 0, "lift": 0.01, "limit": 0.5} | bad))
