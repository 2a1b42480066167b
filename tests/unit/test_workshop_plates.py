"""Plates as DXF and STEP, read back: by the programs' own readers, and by ezdxf's flattening of what it read."""

import importlib.util
import math
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.entitydb import EntityDB
from ezdxf.path import make_path
from link_plates import link_plate
from processes import printed, python

from ilmek.cams.laws import LAWS
from ilmek.cams.limits import area
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import CamProgramme, dwell, fall, rise
from ilmek.elements.plates import round_bore, zero_mark
from ilmek.errors import OutputError, ParameterError
from ilmek.io.dxf import LAYERS, read_dxf, write_dxf
from ilmek.part.shapes import rectangle
from ilmek.report import Hole, Plate

CAM = PlateCam(
    CamProgramme(
        (rise(1.5, 0.03, LAWS["modified-sine"]), dwell(1.0), fall(1.5, 0.03, LAWS["cycloidal"]), dwell(math.tau - 4.0))
    ),
    0.05,
    roller_radius=0.010,
)


def cam_plate(name: str = "cam") -> Plate:
    angle = np.arange(720) * math.tau / 720  # by the cam's angle the surface runs clockwise
    return Plate(
        name,
        "Plate cam",
        CAM.surface(angle),
        0.012,
        "16MnCr5",
        paths={"pitch curve": CAM.pitch(angle), "cutter path": CAM.pitch(angle)},
        marks=zero_mark(0.04),
        area=area(CAM),
        number=2,
        **round_bore(0.025)._asdict(),
    )


def coupler() -> Plate:
    pins = [("A", 0j), ("B", 0.2 + 0j), ("C", 0.08 + 0.09j)]
    return link_plate("coupler", "Coupler", pins, hole_radius=0.006, width=0.03, thickness=0.008, material="S235JR")


def square_bored() -> Plate:
    surface = CAM.surface(np.arange(720) * math.tau / 720)
    bore = rectangle(0.02, 0.02)
    return Plate("shed", "Shedding cam", surface, 0.0018, "POM", number=600, cutouts=(bore,))


PLATES = {plate.name: plate for plate in (cam_plate(), coupler(), square_bored())}


def shoelace(points: np.ndarray) -> float:
    return 0.5 * abs(float(np.sum((np.conj(points) * np.roll(points, -1)).imag)))


@pytest.mark.parametrize("name", PLATES)
def test_a_dxf_reads_back_without_an_error_and_with_its_area(name: str, tmp_path: Path) -> None:
    plate = PLATES[name]
    shape = write_dxf(tmp_path / "plate.dxf", plate)
    document = ezdxf.readfile(tmp_path / "plate.dxf")
    assert not document.audit().errors
    assert document.header["$INSUNITS"] == 4  # mm
    assert {layer.dxf.name for layer in document.layers} >= set(LAYERS)
    flat = [
        1e-3 * np.array([complex(v.x, v.y) for v in make_path(line).flattening(1e-4)])[:-1]
        for line in document.modelspace().query('LWPOLYLINE[layer=="PROFILE"]')
    ]
    expected = plate.area if plate.area is not None else area(CAM)
    assert len(flat) == 1
    assert shoelace(flat[0]) == pytest.approx(expected, rel=1e-5)
    facts = read_dxf(tmp_path / "plate.dxf")
    assert facts.area == pytest.approx(expected, rel=1e-6)
    assert facts.bored == pytest.approx(shape.bored, rel=1e-9)
    assert facts.errors == 0
    assert shape.error <= 1.001e-6 * shape.size


def test_a_dxf_says_what_the_plate_is_and_measures_it(tmp_path: Path) -> None:
    write_dxf(tmp_path / "plate.dxf", coupler())
    space = ezdxf.readfile(tmp_path / "plate.dxf").modelspace()
    measured = {round(line.get_measurement(), 6) for line in space.query("DIMENSION[dimtype!=35]")}
    assert measured >= {200.0, 150.0, 230.0, 120.0, round(1e3 * abs(0.08 + 0.09j), 6)}
    texts = " | ".join(text.dxf.text for text in space.query("TEXT"))
    assert "Coupler (coupler)" in texts
    assert "S235JR, 8 mm thick, 1 piece" in texts
    assert len(space.query('LINE[layer=="CENTRE"]')) == 6


def test_keyway_and_mark_are_where_they_belong(tmp_path: Path) -> None:
    write_dxf(tmp_path / "plate.dxf", cam_plate())
    space = ezdxf.readfile(tmp_path / "plate.dxf").modelspace()
    (bore,) = space.query('LWPOLYLINE[layer=="BORE"]')
    assert max(x for x, _ in bore.get_points("xy")) == pytest.approx(12.5 + 3.3)
    (mark,) = space.query('LWPOLYLINE[layer=="MARK"]')
    assert mark.get_points("xy") == [pytest.approx((36.0, 0.0)), pytest.approx((40.0, 0.0))]
    assert len(space.query('LWPOLYLINE[layer=="CUTTER_PATH"]')) == len(space.query('LWPOLYLINE[layer=="PITCH"]')) == 1


def test_the_same_plate_gives_the_same_bytes_in_every_process(tmp_path: Path) -> None:
    script = (
        "import sys; from pathlib import Path; import numpy as np; from ilmek.io.dxf import write_dxf\n"
        "from ilmek.report import Plate\n"
        "write_dxf(Path(sys.argv[1]), Plate('p', 'p', np.array([0, 0.1, 0.1 + 0.1j]), 0.01, 'steel'))"
    )
    for seed in "123":
        printed(python("-c", script, tmp_path / seed), changes={"PYTHONHASHSEED": seed})
    assert len({path.read_bytes() for path in tmp_path.iterdir()}) == 1


def test_a_file_that_is_no_plate_is_refused(tmp_path: Path) -> None:
    (tmp_path / "text.dxf").write_text("no drawing")
    with pytest.raises(OutputError, match="cannot be read back"):
        read_dxf(tmp_path / "text.dxf")
    ezdxf.new().saveas(tmp_path / "empty.dxf")
    with pytest.raises(OutputError, match="has 0 outlines; a plate has one"):
        read_dxf(tmp_path / "empty.dxf")


def ocp_loads() -> bool:
    try:
        return importlib.import_module("OCP.gp") is not None
    except ImportError:  # not installed, or without the system's libGL
        return False


@pytest.mark.skipif(not ocp_loads(), reason="the extra `step` is not there")
@pytest.mark.parametrize("name", ["cam", "coupler"])
def test_a_step_file_reads_back_with_area_times_thickness(name: str, tmp_path: Path) -> None:
    step = importlib.import_module("ilmek.io.step")
    plate = PLATES[name]
    shape = write_dxf(tmp_path / "plate.dxf", plate)
    step.write_step(tmp_path / "plate.step", plate, shape)
    face = (plate.area if plate.area is not None else area(CAM)) - shape.bored
    assert step.read_step_volume(tmp_path / "plate.step") == pytest.approx(face * plate.thickness, rel=1e-6)
    assert f"PRODUCT('{plate.name}" in (tmp_path / "plate.step").read_text()


@pytest.mark.skipif(not ocp_loads(), reason="the extra `step` is not there")
def test_a_step_file_that_is_none_is_refused(tmp_path: Path) -> None:
    step = importlib.import_module("ilmek.io.step")
    with pytest.raises(OutputError, match="cannot be read back as STEP"):
        step.read_step_volume(tmp_path / "nothing.step")


def test_a_bore_without_a_key_of_its_size_is_refused() -> None:
    with pytest.raises(ParameterError, match="no parallel key for a shaft of 150 mm; above 6 mm, at most 130 mm"):
        round_bore(0.15)


def test_a_plain_bore_is_a_hole() -> None:
    assert round_bore(0.15, key=False).holes == (Hole(0j, 0.075, "bore"),)


def test_dxf_does_not_depend_on_the_order_of_a_set(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    in_use = EntityDB.dxf_types_in_use
    for backward in (False, True):
        monkeypatch.setattr(
            EntityDB, "dxf_types_in_use", lambda db, b=backward: dict.fromkeys(sorted(in_use(db), reverse=b))
        )
        write_dxf(tmp_path / f"{backward}.dxf", coupler())
    assert (tmp_path / "False.dxf").read_bytes() == (tmp_path / "True.dxf").read_bytes()
