"""The keys of a head: moments of their shapes by their meshes, pressures by the force on a key's side."""

import numpy as np
import pytest

from ilmek.machines.weaver import MACHINE, Weaver, WeaverParams
from ilmek.machines.weaver.hub_keys import SMALL_KEY, STACK_KEY, grooved, keyed_ring
from ilmek.machines.weaver.parts import SHAFT
from ilmek.machines.weaver.transmissions import CAM_SHAFT
from ilmek.machines.weaver.tree import head_tree
from ilmek.plane.solids import is_closed, volume
from ilmek.units import mm

HEADS = tuple(
    MACHINE.design(WeaverParams(**settings)) for settings in ({}, {"shaft": 20 * mm}, {"cam_thickness": 10 * mm})
)


@pytest.mark.parametrize("diameter", [14 * mm, 15 * mm, 20 * mm])
def test_groove_and_keyway_take_their_share_of_the_volume(diameter: float) -> None:
    ring, shaft = keyed_ring(diameter, 10 * mm), grooved(diameter, 10 * mm)
    for shape in (ring, shaft):
        assert is_closed(shape.mesh())
        assert volume(shape.mesh(1e-6)) == pytest.approx(shape.volume, rel=1e-3)
    assert shaft.volume < np.pi / 4 * diameter**2 * 10 * mm
    outer = np.ptp(ring.mesh().points[:, 1])
    assert ring.volume < np.pi / 4 * (outer**2 - diameter**2) * 10 * mm


@pytest.mark.parametrize("weaver", HEADS)
def test_a_key_fills_its_groove_and_bears_the_torque_on_its_side(weaver: Weaver) -> None:
    shaft = weaver.params.shaft
    body = head_tree(weaver).body(CAM_SHAFT)
    parts = {one.part.id: one for one in body.occurrences}
    key = parts[STACK_KEY]
    (position,) = key.positions
    assert key.part.shape is not None
    corners = position.points(key.part.shape.mesh().points)
    width = float(np.ptp(corners[:, 1]))
    below, above = shaft / 2 - float(corners[:, 0].min()), float(corners[:, 0].max()) - shaft / 2
    assert parts[SHAFT].part.shape is not None
    groove = parts[SHAFT].part.shape.mesh().points
    inner = groove[(np.abs(groove[:, 1]) < width / 2 + 1e-9) & (groove[:, 0] > 0)]
    assert float(inner[:, 0].min()) == pytest.approx(shaft / 2 - below, abs=1e-9)
    for name, hub in parts.items():  # one key through all of them, and nothing of it beyond
        if "cam" in name and name not in {STACK_KEY, SHAFT}:
            assert hub.part.shape is not None
            ends = [one.points(hub.part.shape.mesh().points)[:, 2] for one in hub.positions]
            assert all(z.min() > corners[:, 2].min() - 0.51 * mm for z in ends)
            assert all(z.max() < corners[:, 2].max() + 0.51 * mm for z in ends)
    checks = {check.name: check for check in MACHINE.report(weaver).checks}
    most = max(float(np.abs(cam.torque).max()) for cam in weaver.cams)
    for name, torque, length in (
        ("key of the head's cams", most, weaver.params.cam_thickness),
        ("key of the pulley of the cam shaft", weaver.belt.torque, 10 * mm),
    ):
        pressure = torque / (shaft / 2) / (above * length)
        assert checks[name].value == pytest.approx(pressure, rel=1e-9)
        assert checks[name].parts == (STACK_KEY,)
    small = weaver.belt.torque * 30 / weaver.belt.large / 7e-3 / (2e-3 * 10e-3)  # DIN 6885-1 5 x 5, 3 mm in the shaft
    (own,) = (check for check in checks.values() if check.parts == (SMALL_KEY,))
    assert own.value == pytest.approx(small, rel=1e-9)


def test_a_thin_shaft_fails() -> None:
    report = MACHINE.report(MACHINE.design(WeaverParams(shaft=7 * mm, contact_force=50.0)))
    assert "key of the pulley of the cam shaft" in {check.name for check in report.failed}
