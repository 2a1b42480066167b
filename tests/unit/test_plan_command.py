"""`ilmek plan`: the shipped example to its numbers, its files, and bad input."""

import csv
import json
import shutil
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from default_machines import out_of_space
from PIL import Image
from small_programme import small_programme

from ilmek.cli import main
from ilmek.io.chart.formats import FORMATS
from ilmek.io.looms_file import read_looms
from ilmek.io.orders_file import read_orders
from ilmek.io.programme_file import write_programme
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import read_order, recipe_parameters
from ilmek.jobs.plan_inputs import read_inputs

EXAMPLES = Path(__file__).parents[2] / "examples"
TWO_INDICES = Path(__file__).parents[1] / "data" / "two-indices.bmp"
RED, IVORY, NAVY = (158, 43, 37), (239, 230, 208), (27, 36, 66)
WOOL = "name,srgb\nred,#9e2b25\nivory,#efe6d0\nnavy,#1b2442\n"
NAMES = {
    "orders", "bound", "cost", "loom_cost", "late_cost", "gap", "currency", "status", "repeatable", "horizon", "looms",
    "late_orders", "late_carpets", "least_late", "yarn", "yarn_price", "begun",
}  # fmt: skip
ORDER_NAMES = {"name", "loom", "start", "end", "cost", "late", "due", "woven", "quantity", "carpets", "moved"}


def plan(folder: Path, *more: str) -> Result:
    return CliRunner().invoke(main, ["plan", str(folder / "orders.toml"), "--looms", str(folder / "looms.toml"), *more])


pytestmark = pytest.mark.usefixtures("not_in_space")


@pytest.fixture(scope="module")
def example(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, Any], Path]:
    out = tmp_path_factory.mktemp("plan") / "out"
    with out_of_space():
        done = plan(EXAMPLES, "--out", str(out), "--json", "-", "--time-limit", "200s")
    assert done.exit_code == 3, done.output
    return json.loads(done.stdout), out


def test_the_example_is_planned_to_its_numbers(example: tuple[dict[str, Any], Path]) -> None:
    found, _ = example
    assert found["job"] == "plan"
    assert found["results"].keys() == NAMES
    assert all(order.keys() == ORDER_NAMES for order in found["orders"])
    assert found["cost"] == pytest.approx(3111.32, rel=0.01)
    assert found["bound"] == found["cost"]
    assert found["status"] == "optimal"
    assert {order["name"]: order["loom"] for order in found["orders"]} == {
        "Kazak": "A", "Prayer rug": "A", "Tabriz": "B", "Tekke": "B",
    }  # fmt: skip
    assert [order["name"] for order in found["orders"] if order["late"]] == ["Kazak"]
    assert found["orders"][0]["late"] == pytest.approx(68 * 3600, abs=3 * 3600)
    assert found["orders"][2]["end"].startswith("2026-12-23T1")
    bought = {one["name"]: one for one in found["yarn"]}
    assert bought["madder red"]["needed"] - bought["madder red"]["to_buy"] == pytest.approx(6.0)
    assert bought["ivory"]["order_by"] == "2026-12-02T06:00"


def test_measures_of_the_example_save_its_late_order(example: tuple[dict[str, Any], Path]) -> None:
    found = example[0]
    (late,) = found["late_orders"]
    assert late["name"] == "Kazak"
    measures = {one["measure"]: one for one in late["measures"]}
    assert measures["overtime"]["time"] == 3600
    assert measures["overtime"]["cost"] == found["loom_cost"] < found["cost"]
    assert measures["later due date"]["time"] == pytest.approx(68 * 3600, abs=3 * 3600)
    assert "yarn at once" in measures


def test_a_carpet_of_a_plan_is_finished_by_its_steps_of_making(example: tuple[dict[str, Any], Path]) -> None:
    """After the loom 900 s and 360 s a square metre, then two days to dry; 12 EUR a square metre. On it: its cost."""
    found = example[0]
    areas = {order["name"]: order["carpets"][0]["making_steps"][3]["time"] / 900 for order in found["orders"]}
    assert areas["Tabriz"] == pytest.approx(1.4 * 2.0)
    for order in found["orders"]:
        for one in order["carpets"]:
            steps = {step["name"]: step for step in one["making_steps"]}
            assert steps["weaving"]["time"] == one["weaving_time"]
            lost = one["cost"] - sum(steps[name]["cost"] for name in ("warping", "weaving", "taking down"))
            assert lost == pytest.approx(0.0, abs=3e-4) or one["late"]
            off = [steps[name] for name in ("inspection", "shearing", "washing")]
            assert sum(step["cost"] for step in off) == pytest.approx(12 * areas[order["name"]])
            after = datetime.fromisoformat(one["finished"]) - datetime.fromisoformat(one["end"])
            assert 0 <= after.total_seconds() - 1260 * areas[order["name"]] - 48 * 3600 < 60


def test_the_files_of_a_plan_agree(example: tuple[dict[str, Any], Path]) -> None:
    found, out = example
    assert sorted(path.name for path in out.iterdir() if not path.name.startswith(".")) == [
        "plan.csv", "plan.html", "plan.json", "plan.svg", "purchase.csv",
    ]  # fmt: skip
    rows = list(csv.DictReader((out / "plan.csv").read_text(encoding="utf-8").splitlines()))
    assert len(rows) == 5
    assert sum(float(row["cost [EUR]"]) for row in rows) == pytest.approx(found["cost"], abs=0.03)
    yarn = list(csv.DictReader((out / "purchase.csv").read_text(encoding="utf-8").splitlines()))
    assert [row["yarn"] for row in yarn] == [one["name"] for one in found["yarn"]]
    page = (out / "plan.html").read_text(encoding="utf-8")
    assert all(order["name"] in page for order in found["orders"])
    assert "due Kazak" in (out / "plan.svg").read_text(encoding="utf-8")


ORDERS = """start = 2026-12-01T06:00:00
late = "40 EUR/d"
[[order]]
name = "one"
picture = "medallion.png"
size = "60x90cm"
colours = 6
due = 2026-12-18
most_lost = "100%"
least_detail = "0%"
"""
LOOMS = """[[shift]]
name = "day"
days = "Mon-Fri"
hours = "06:00-14:00"
[[loom]]
name = "A"
design = { width = "1.2m", colours = 8 }
cost = "14 EUR/h"
dressing = "12h"
doffing = "90min"
"""

BAD_ORDERS = {
    "no unit": (('"40 EUR/d"', "40"), "line 2, late: 40 is not money"),
    "other currency": (('"40 EUR/d"', '"40 USD/d"'), "line 2, late: '40 USD/d' is in another currency"),
    "per mass": (('"40 EUR/d"', '"40 EUR/kg"'), "line 2, late: '40 EUR/kg' has the wrong unit"),
    "no due date": (("due = 2026-12-18\n", ""), "line 3, order.0: has no 'due'"),
    "no date": (("2026-12-18", '"soon"'), "line 8, order.0.due: 'soon' is no date"),
    "an offset": (("2026-12-18", "2026-12-18T10:00:00Z"), "has an offset; local time"),
    "unknown key": (("colours", "colour"), "unknown key 'colour'"),
    "no quality": (("colours = 6", 'quality = "many"'), "line 3"),
    "outside": (("medallion.png", "../medallion.png"), "reaches outside the folder of the orders"),
    "missing": (("medallion.png", "none.png"), "is not there"),
    "both": (
        ('picture = "medallion.png"', 'picture = "medallion.png"\nprogramme = "p.ilmek"'),
        "has both picture and programme",
    ),
    "too many": (("due", "quantity = 3001\ndue"), "a whole number, 1 to 3000"),
    "year": (("2026-12-18", "9026-12-18"), "the year 9026; 1900 to 2200"),
    "far away": (("due", "earliest = 2199-01-01\ndue"), "the plan does not end within 1830 days"),
}
BAD_LOOMS = {
    "no unit": (('"12h"', "12"), 'line 9, loom.0.dressing: 12 has no unit; text in h; write it like "2h"'),
    "no money": (('"14 EUR/h"', "14"), "line 8, loom.0.cost: 14 is not money"),
    "no currency": (('"14 EUR/h"', '"14 h"'), "in another currency, or in none; the currency of the file: EUR; write"),
    "hours": (("06:00-14:00", "6-14"), "line 4, shift.0.hours: '6-14' are no hours"),
    "day": (("Mon-Fri", "Mon-Fry"), "line 3, shift.0.days: 'Mon-Fry' are no days of the week"),
    "shift": (('name = "A"', 'name = "A"\nshifts = ["nigt"]'), "unknown shift"),
    "nobody": (
        ('hours = "06:00-14:00"', 'hours = "06:00-14:00"\nattended = false'),
        "no shift of the loom is attended",
    ),
    "design": (("colours = 8", "colors = 8"), "line 5: unknown parameter 'colors'"),
    "neither": (('design = { width = "1.2m", colours = 8 }\n', ""), "none or of several of file, design and weavers"),
    "stops": (("doffing", 'stops = "95%"\ndoffing'), "is out of bounds; 0 to 90 %"),
    "downtime": (("doffing", 'downtime = ["2026-12-07"]\ndoffing'), "is no begin and end; write it like"),
    "downtime ends first": (("doffing", 'downtime = ["2026-12-07/2026-12-01"]\ndoffing'), "ends before it begins"),
    "weaving what": (("doffing", 'weaving = { order = "two", rows = 1 }\ndoffing'), "unknown order 'two'"),
    "weaving how far": (("doffing", 'weaving = { order = "one" }\ndoffing'), "none or of both of run and rows"),
    "weaving past its end": (("doffing", 'weaving = { order = "one", rows = 9999 }\ndoffing'), "at most the 225"),
    "no run": (("doffing", 'weaving = { order = "one", run = "a" }\ndoffing'), "is not there"),
    "currency": (("[[shift]]", 'currency = "TRY"\n[[shift]]'), "another currency"),
}


def written(folder: Path, orders: str = ORDERS, looms: str = LOOMS) -> Path:
    (folder / "orders.toml").write_text(orders, encoding="utf-8")
    (folder / "looms.toml").write_text(looms, encoding="utf-8")
    shutil.copy(EXAMPLES / "medallion.png", folder)
    return folder


@pytest.mark.parametrize("name", BAD_ORDERS)
def test_bad_orders_are_one_clear_error(tmp_path: Path, name: str) -> None:
    (old, new), message = BAD_ORDERS[name]
    done = plan(written(tmp_path, orders=ORDERS.replace(old, new, 1)))
    assert done.exit_code == 2
    assert message in " ".join(done.stderr.split())


@pytest.mark.parametrize("name", BAD_LOOMS)
def test_bad_looms_are_one_clear_error(tmp_path: Path, name: str) -> None:
    (old, new), message = BAD_LOOMS[name]
    done = plan(written(tmp_path, looms=LOOMS.replace(old, new, 1)))
    assert done.exit_code == 2
    assert message in " ".join(done.stderr.split())


BEGUN = 'downtime = ["2026-12-02T08:00/2026-12-02T10:00"]\nweaving = { order = "one", rows = 25, since = 2026-11-30 }\n'


def test_what_is_on_a_loom_stays_there_at_its_own_pace(tmp_path: Path) -> None:
    """25 of 225 rows in 8 h of Monday: 200 rows take 64 h from Tuesday 06:00 on, 90 min of doffing, 2 h of downtime."""
    first = written(tmp_path, orders=ORDERS.replace("due", "quantity = 2\ndue"))
    assert plan(first, "--out", str(tmp_path / "first"), "--json", str(tmp_path / "first.json")).exit_code == 0
    written(tmp_path, (first / "orders.toml").read_text(), LOOMS.replace("doffing", BEGUN + "doffing"))
    done = plan(first, "--now", "2026-12-01T06:00", "--against", str(tmp_path / "first.json"), "--json", "-")
    found = json.loads(done.stdout)
    (carpet,), (order,) = found["begun"], found["orders"]
    # 8 days of 8 h from Tuesday on are over on Thursday of the next week; 2 h and 90 min later it is Friday, 09:30.
    assert (carpet["rows"], carpet["of"], carpet["end"]) == (25, 225, "2026-12-11T09:30")
    assert [(one["start"], one["same_setup"]) for one in order["carpets"]] == [("2026-12-11T09:30", True)]
    earlier = json.loads((tmp_path / "first.json").read_text())["orders"][0]["end"]
    moved = datetime.fromisoformat(order["end"]) - datetime.fromisoformat(earlier)
    assert order["moved"] == moved.total_seconds() > 0


def test_slips_that_only_make_the_plan_worse_are_noted(tmp_path: Path) -> None:
    stock = LOOMS + '[[yarn]]\nname = "madder rde"\nstock = "6kg"\n'
    found = plan(written(tmp_path, orders=ORDERS.replace("2026-12-18", "2025-12-18"), looms=stock), "--json", "-")
    assert found.exit_code == 3
    due, yarn = json.loads(found.stdout)["warnings"][:2]
    assert "due 2025-12-18 23:59 is before its earliest begin" in due
    assert yarn == "looms.toml: no carpet of the plan takes the yarn 'madder rde' (did you mean 'madder red'?)"


def test_a_carpet_that_no_loom_weaves_is_named_with_its_cure(tmp_path: Path) -> None:
    found = plan(written(tmp_path, orders=ORDERS.replace("60x90cm", "200x90cm")), "--json", "-")
    assert found.exit_code == 3
    data = json.loads(found.stdout)
    (order,) = data["orders"]
    assert (order["loom"], order["start"], order["late"], order["woven"]) == (None, None, None, False)
    assert data["bound"] is None
    warps = next(one for one in data["reasons"] if one["name"] == "one on A: carpet: warps")
    assert "width" in warps["cure"]


def test_without_the_solver_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "ortools.sat.python.cp_model", None)
    done = plan(written(tmp_path))
    assert done.exit_code == 2
    assert "pip install 'ilmek[planning]'" in done.stderr


@pytest.mark.parametrize("text", ["60", "0s", "2h", "fast"])
def test_a_time_limit_has_its_unit_and_bounds(tmp_path: Path, text: str) -> None:
    assert plan(written(tmp_path), "--time-limit", text).exit_code == 2


def test_a_programme_is_woven_only_by_the_loom_that_it_was_compiled_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    programme = small_programme(6, 12, 2, 3, seed=1)
    write_programme(tmp_path / "p.ilmek", programme)
    orders = ORDERS.partition("picture")[0] + 'programme = "p.ilmek"\ndue = 2026-12-18\n'
    found = json.loads(plan(written(tmp_path, orders=orders), "--json", "-").stdout)
    assert [one["name"] for one in found["reasons"]] == ["one on A: programme: compiled for this loom"]
    monkeypatch.setattr("ilmek.jobs.plan_fits.loom_digest", lambda _: programme.setup.loom)
    found = json.loads(plan(tmp_path, "--aim", "late", "--json", "-").stdout)
    (order,) = found["orders"]
    assert (order["loom"], order["late"]) == ("A", 0)
    assert (found["late_carpets"], found["least_late"], found["parameters"]["aim"]) == (0, 0, "late")
    assert found["cost"] == pytest.approx(found["loom_cost"])  # without the fine of the search


@pytest.mark.parametrize("case", ["two-indices", "three positions", "a chart"])
def test_a_yarn_on_two_positions_of_the_creel_is_bought_as_one(tmp_path: Path, case: str) -> None:
    """The same drawing with one index for each colour, and the looms' stock of it, are the judges."""
    indices = np.random.default_rng(3).integers(0, 4, (48, 24), dtype=np.uint8)
    colours = {"three positions": (RED, IVORY, RED, RED)}.get(case, (RED, IVORY, RED, NAVY))
    if case == "two-indices":
        with Image.open(TWO_INDICES) as image:
            indices = np.array(image)
    merged = np.array([colours.index(colour) for colour in colours], dtype=np.uint8)[indices]
    jobs, yarns = [], []
    for name, drawn in (("apart", indices), ("merged", merged)):
        picture = Image.fromarray(drawn, "P")
        picture.putpalette([code for colour in colours for code in colour])
        picture.save(tmp_path / f"{name}.png", dpi=(6.35, 6.35))
        (tmp_path / "wool.csv").write_text(WOOL)
        yarn_key = 'yarns = "wool.csv"\n'
        if case == "a chart":  # which has its yarns
            drawing, yarn_key = read_order(tmp_path / f"{name}.png", yarn_file=tmp_path / "wool.csv"), ""
            FORMATS["png"].save(tmp_path / f"{name}.png", make_charted(drawing).chart)
        orders = ORDERS.partition("picture")[0] + f'picture = "{name}.png"\n{yarn_key}due = 2026-12-18\n'
        looms = LOOMS + '[[yarn]]\nname = "red"\nstock = "1kg"\nlead = "2d"\n'
        folder = written(tmp_path, orders=orders, looms=looms)
        inputs = read_inputs(
            read_orders(folder / "orders.toml", recipe_parameters()), read_looms(folder / "looms.toml")
        )
        yarns.append({yarn.name: yarn.stock for yarn in inputs.factory.yarns})
        (job,) = inputs.factory.jobs
        names = [yarn.name for yarn in inputs.factory.yarns]
        jobs.append({names[yarn]: grams for yarn, grams in job.yarns.items()})
    assert yarns[0] == yarns[1]
    assert yarns[0]["red"] == 1000
    assert not any("creel" in name for name in jobs[0])
    for name, grams in jobs[1].items():
        assert grams <= jobs[0][name] <= grams + 2  # whole grams of each position
