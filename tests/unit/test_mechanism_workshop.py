"""The links and laws of an own mechanism as files for the workshop and the controller."""

import json
import math
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from ilmek.cli.mechanism import command
from ilmek.io.mechanism_file import parse_mechanism
from ilmek.jobs.mechanism.parts import cam_tables
from ilmek.machines.catalogue import MACHINES

TEXT = """\
name = "indexer"
links = { width = "24mm", thickness = "8mm", material = "structural steel" }
[bodies]
ground.points = { O = [0, 0], C = ["120mm", 0] }
crank.length = "40mm"
rod.points = { A = [0, 0], B = ["100mm", 0], P = ["50mm", "60mm"] }
rocker = { length = "90mm", mass = "1kg" }
[joints]
O.pin = ["ground", "crank"]
A.pin = ["crank", "rod"]
B.pin = ["rod", "rocker"]
C.pin = ["ground", "rocker"]
[inputs]
O = "crank"
[branches]
B = 1
[pins]
B = { diameter = "12mm", length = "20mm" }
"""


def test_a_periodic_law_of_an_input_is_a_cam_table_and_a_constant_speed_is_none() -> None:
    assert cam_tables(parse_mechanism(TEXT + '[motions]\nO = "60rpm"\n').machine) == ()
    law = '[motions]\nO = { table = [["0s", "0deg"], ["0.5s", "90deg"], ["1s", "0deg"]] }\n'
    (table,) = cam_tables(parse_mechanism(TEXT + law).machine)
    assert (table.unit, table.period, table.revolves) == ("deg", 1.0, pytest.approx(0.0, abs=1e-12))
    s, ds, _ = table.motion(np.array([0.0, math.pi, math.pi + 1e-4]))
    assert s[1] == pytest.approx(math.pi / 2)
    assert (s[2] - s[1]) / 1e-4 == pytest.approx(ds[1], abs=1e-3)


def test_the_command_writes_the_links(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(TEXT, encoding="utf-8")
    found = CliRunner().invoke(command, [str(file), "--workshop", str(tmp_path / "parts"), "--json", "-"])
    assert found.exit_code == 0, found.output
    assert any(path.endswith("rod.dxf") for path in json.loads(found.stdout)["files"])
    assert (tmp_path / "parts" / "crank.dxf").exists()


@pytest.mark.parametrize("name", ["motion-four-bar", "function-four-bar"])
def test_a_synthesised_four_bar_gives_its_links(name: str) -> None:
    machine = MACHINES[name]
    made = machine.design(machine.params(link_width=0.012))
    links = {plate.name: plate for plate in machine.plates(made)}
    assert list(links) == ["frame", "crank", "rocker", "coupler"]
    lengths = made.best.candidate.four_bar.lengths
    for link, plate in links.items():
        points = [hole.at for hole in plate.holes]
        apart = [abs(second - first) for first, second in combinations(points, 2)]
        assert getattr(lengths, "ground" if link == "frame" else link) in [pytest.approx(one) for one in apart]
        assert plate.thickness == pytest.approx(0.008 if link == "frame" else 0.004)
