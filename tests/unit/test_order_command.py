"""`ilmek order`, `ilmek verify`: prices by hand, papers read back, labels, records with a changed byte, bad input."""

import hashlib
import json
import math
import re
import shutil
from dataclasses import replace
from decimal import ROUND_HALF_UP, Decimal
from pathlib import Path
from typing import Any

import numpy as np
import pypdf
import pytest
from click.testing import CliRunner, Result
from cryptography.exceptions import InvalidSignature
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey
from PIL import Image

import ilmek
from ilmek.api.carpets import read_chart
from ilmek.carpet.chart import Chart
from ilmek.carpet.colourways import Colourway, recoloured
from ilmek.carpet.construction import CarpetConstruction, construction_of
from ilmek.carpet.price_rules import WageRules, woven_in_rows
from ilmek.carpet.shape import ShapeParams, shaped
from ilmek.carpet.strike_off import part_of, strike_off_window
from ilmek.carpet.yarn_plan import YarnPlanParams
from ilmek.cli import main
from ilmek.errors import CarpetError, LoomError
from ilmek.io.call_state import CallState, chart_digest, state_file, write_state
from ilmek.io.carpet_record import read_record, record_faults
from ilmek.io.chart.png import read_chart_png
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.ordering.progress import woven_rows
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.viz.room import HIGH, WIDE, draw_room

EXAMPLES = Path(__file__).parents[2] / "examples"
ORDER = """
customer = "N-204"
start = 2026-12-01T07:00:00
late = "10 EUR/d"
[price]
margin = "30%"
tax = "19%"
discount = { 2 = "3%", 9 = "8%" }
[wage]
amount = "3.2 EUR"
colours = 3
supplement = "2%"
advance = "20%"
rows = 15
[[order]]
name = "Medallion"
picture = "medallion.png"
size = "30x40cm"
quality = "10x10/dm"
yarns = "wool"
colours = 4
least_detail = "35%"
due = 2026-12-31
[[order.colourway]]
name = "madder"
[[order.colourway]]
name = "indigo"
quantity = 2
map = { "indigo navy" = "light blue" }
"""


def run(*words: str | Path) -> Result:
    return CliRunner().invoke(main, [str(word) for word in words])


def written(folder: Path, text: str = ORDER) -> Path:
    shutil.copy(EXAMPLES / "medallion.png", folder)
    (folder / "order.toml").write_text(text, encoding="utf-8")
    return folder / "order.toml"


@pytest.fixture(scope="module")
def worked(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, Any], Path]:
    folder = tmp_path_factory.mktemp("order")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_STATE_HOME", str(folder / "state"))
        words = ("--out", folder / "out", "--key", folder / "a.key", "--json", "-")
        done = run("order", written(folder), *words)
    assert done.exit_code == 0, done.output
    return json.loads(done.stdout), folder / "out"


def half_up(amount: float | Decimal) -> Decimal:
    return Decimal(str(amount)).quantize(Decimal("0.01"), ROUND_HALF_UP)


def text_of(path: Path) -> str:
    return " ".join(" ".join(page.extract_text() for page in pypdf.PdfReader(path).pages).replace("\u202f", "").split())


def test_prices_are_those_of_a_hand_calculation(worked: tuple[dict[str, Any], Path]) -> None:
    found, _ = worked
    nets = []
    for one in found["carpets"]:
        assert half_up(sum(Decimal(str(cost)) for cost in one["costs"].values())) == half_up(one["cost"])
        wage = Decimal("3.2") * one["knots"] / 1000 * (1 + Decimal("0.02") * (len(one["yarns"]) - 3))
        assert half_up(wage) == half_up(one["wage"]) == half_up(one["costs"]["wage"])
        assert half_up(one["costs"]["finishing"]) == half_up(Decimal("0.12") * 12)
        assert half_up(one["unit_price"]) == half_up(half_up(one["cost"]) * Decimal("1.3"))
        nets.append(half_up(one["quantity"] * half_up(one["unit_price"]) * Decimal("0.97")))
        assert half_up(one["net"]) == nets[-1]
    assert half_up(found["net"]) == sum(nets)
    assert half_up(found["total"]) == sum(nets) + sum(half_up(net * Decimal("0.19")) for net in nets)
    assert [one["quantity"] for one in found["carpets"]] == [1, 2]


def test_the_papers_say_what_the_json_says(worked: tuple[dict[str, Any], Path]) -> None:
    found, folder = worked
    quotation, approval = (text_of(folder / "offer" / name) for name in ("quotation.pdf", "approval.pdf"))
    for text in ("N-204", "2026-12-01", "2026-12-31", f"{found['total']:.2f}", f"{found['net']:.2f}"):
        assert text in quotation
    for one in found["carpets"]:
        costs = [f"{cost:.2f}" for cost in one["costs"].values()]
        for text in (one["name"], f"{one['unit_price']:.2f}", f"{one['net']:.2f}", one["delivery"], *costs):
            assert text in quotation
        for text in (one["name"], *one["yarns"], f"{one['mass']:.2f} kg", f"{one['knots']}", "30 × 40 cm", "rectangle"):
            assert text in approval


def test_a_workshop_folder_is_enough_to_weave_from(worked: tuple[dict[str, Any], Path]) -> None:
    found, folder = worked
    one, own = found["carpets"][1], folder / "medallion-indigo"
    names = {path.name for path in own.iterdir()}
    papers = {"chart.pdf", "rows.pdf", "rows.txt", "yarn.csv", "mounting.pdf", "wages.pdf", "strike-off.pdf"}
    assert papers | {"record-1.json", "record-2.json", "label-1.pdf", "label-2.pdf", "chart.png"} <= names
    chart = read_chart(own / "chart.png")
    assert (chart.rows, chart.columns) == (one["rows"], one["columns"]) == (40, 30)
    mounting = text_of(own / "mounting.pdf")
    assert f"{2 * 30 + 8}, of which 8 at the edges" in mounting
    assert "between rows 20 and 21" in mounting
    wages = text_of(own / "wages.pdf")
    assert f"{one['wage']:.2f} EUR" in wages
    for name in ("chart.pdf", "rows.pdf", "strike-off.pdf", "mounting.pdf", "wages.pdf"):
        assert one["name"] in text_of(own / name)
    assert f"# {one['name']}" in (own / "rows.txt").read_text(encoding="utf-8")
    assert "0 of 40 rows" in wages


def test_the_code_of_a_label_is_in_its_text(worked: tuple[dict[str, Any], Path]) -> None:
    found, folder = worked
    for number, code in enumerate(found["carpets"][1]["labels"], 1):
        assert code in text_of(folder / "medallion-indigo" / f"label-{number}.pdf").replace(" ", "")
        done = run("verify", code, "--records", folder)
        assert done.exit_code == 0, done.output
        assert "Medallion, indigo" in done.output


def test_a_record_is_signed_as_another_program_verifies_it(worked: tuple[dict[str, Any], Path]) -> None:
    made = json.loads((worked[1] / "medallion-madder" / "record-1.json").read_text())
    digests = json.dumps(made["digests"], ensure_ascii=False, sort_keys=True, separators=(",", ":"))
    whole = hashlib.sha256(digests.encode()).digest()
    public = Ed25519PublicKey.from_public_bytes(bytes.fromhex(made["signature"]["key"]))
    public.verify(bytes.fromhex(made["signature"]["value"]), whole)
    with pytest.raises(InvalidSignature):
        public.verify(bytes.fromhex(made["signature"]["value"]), whole[::-1])
    knots = hashlib.sha256(b'["/design/knots",1200]').hexdigest()[:16]
    assert made["digests"]["/design/knots"] == knots
    record = made["record"]
    assert record["mass"] == pytest.approx(sum(part["mass"] for part in record["fibre"]))
    gases = sum(part["mass"] for part in record["emissions"]["parts"])
    assert record["emissions"]["mass"] == pytest.approx(gases)


def test_every_changed_byte_of_a_record_is_found(worked: tuple[dict[str, Any], Path], tmp_path: Path) -> None:
    data = (worked[1] / "medallion-madder" / "record-1.json").read_bytes()
    copy = tmp_path / "record.json"
    for place in np.random.default_rng(38).choice(len(data), 60, replace=False):
        copy.write_bytes(data[:place] + bytes([data[place] ^ 1]) + data[place + 1 :])
        assert run("verify", copy).exit_code in {2, 3}, place
    copy.write_bytes(data)
    assert run("verify", copy).exit_code == 0


def test_a_changed_record_is_not_to_be_mended(worked: tuple[dict[str, Any], Path], tmp_path: Path) -> None:
    text = (worked[1] / "medallion-madder" / "record-1.json").read_text()
    (tmp_path / "record.json").write_text(text.replace('"knots": 1200', '"knots": 1201'))
    done = run("verify", tmp_path / "record.json")
    assert done.exit_code == 3
    assert "/design/knots was changed: it is now 1201" in done.output
    assert "do not trust this copy" in done.output
    assert "its limit" not in done.output


def test_colourways_of_the_same_knots_are_called_and_recorded_apart(worked: tuple[dict[str, Any], Path]) -> None:
    """A call of the one pays no wage of the other; what is called is the chart of the folder."""
    folder = worked[1] / "medallion-madder"
    one = read_chart_png(folder / "chart.png")
    other = replace(one, yarns=(*one.yarns[1:], one.yarns[0]))
    assert json.loads((folder / "record-1.json").read_text())["record"]["design"]["digest"] == chart_digest(one)
    assert chart_digest(one) != chart_digest(other)
    assert state_file(one) != state_file(other)


def test_what_was_changed_is_named(worked: tuple[dict[str, Any], Path]) -> None:
    made, text = read_record(worked[1] / "medallion-madder" / "record-1.json")
    assert record_faults(made, text) == []
    changed = json.loads(text)
    changed["record"]["yarn"][0]["lots"][0]["lot"] = 7
    assert record_faults(changed, text)[0] == "/yarn/0/lots/0/lot was changed: it is now 7"
    del changed["record"]["energy"]
    assert "/energy was taken away" in record_faults(changed, text)
    digest_too = json.loads(text)
    digest_too["digests"]["/energy"] = "0" * 16
    assert any("signature" in fault for fault in record_faults(digest_too, text))
    assert "line 3 of the file is not as it was written" in record_faults(
        made, text.replace('"identity":', '"identity" :')
    )


def test_a_record_keeps_the_days_of_its_rows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    order, out = written(tmp_path), tmp_path / "out"
    assert run("order", order, "--out", out).exit_code == 0
    chart = read_chart(out / "medallion-madder" / "chart.png")
    for row in (17, 31):
        write_state(state_file(chart), CallState(row, 0, "runs", "right"))
        done = run("order", order, "--out", out, "--force", "--json", "-")
        assert done.exit_code == 0, done.output
    one = json.loads(done.stdout)["carpets"][0]
    record = json.loads((out / "medallion-madder" / "record-1.json").read_text())["record"]
    assert [entry["rows"] for entry in record["rows"]] == [16, 30]
    assert one["rows_woven"] == 30
    payments = WageRules(3.2, 1000, 3, 0.02, 0.2, 15).payments([(30, 0)] * 40, 4)
    assert half_up(one["wage_due"]) == payments[0].paid + payments[1].paid
    assert "30 of 40 rows" in text_of(out / "medallion-madder" / "wages.pdf")


def test_rows_are_read_from_the_journal_of_a_run(tmp_path: Path) -> None:
    ran = run("run", EXAMPLES / "small_programme.txt", "--journal", tmp_path / "run", "--speed", "max")
    assert ran.exit_code == 0, ran.output
    chart = Chart(np.zeros((6, 4)), default_yarns()[:1], "4x6cm", "10x10/dm", "symmetric")
    found = woven_rows(chart, tmp_path / "run")
    assert (found.rows, found.source) == (6, "journal")
    other = Chart(np.zeros((7, 4)), default_yarns()[:1], "4x7cm", "10x10/dm", "symmetric")
    with pytest.raises(LoomError, match="weaves 6 rows, the carpet has 7"):
        woven_rows(other, tmp_path / "run")


def test_payments_are_the_wage() -> None:
    rules = WageRules(9.0, 10_000, advance=0.25, rows=7)
    payments = rules.payments([(31, 0)] * 40, 5)
    assert [one.row for one in payments] == [7, 14, 21, 28, 35, 40]
    assert sum(one.knots for one in payments) == 1240
    assert sum(one.earned for one in payments) == rules.wage(1240, 5) == Decimal("1.12")
    assert sum(one.deducted for one in payments) == Decimal("0.28")


def test_flat_weave_earns_its_share_of_a_knot() -> None:
    """By hand: 4 × 25 cells at a tenth, 36 × 25 knots, 2 EUR for 100 knots; ends are paid with their rows."""
    rules = WageRules(2.0, 100, rows=4, flat=0.1)
    payments = rules.payments([(0, 25)] * 2 + [(25, 0)] * 36 + [(0, 25)] * 2, 5)
    assert [str(payments[at].earned) for at in (0, 1, 9)] == ["1.10", "2.00", "1.10"]
    assert sum(one.earned for one in payments) == Decimal("18.20") == rules.wage(900, 5, 100)


def test_construction_is_that_of_closed_forms() -> None:
    """A circle's edge and the two heights of a chart with kilim ends; the rows of wages are those of the cells."""
    yarns = default_yarns()[:2]
    stripes = np.indices((100, 100))[0] // 10 % 2
    chart = Chart.of(stripes, yarns, "50x50cm", "20x20/dm", "symmetric")

    def found_of(shape: ShapeParams) -> tuple[Chart, CarpetConstruction]:
        made = shaped(chart, shape)
        return made, construction_of(made, made.bill(), shape, YarnPlanParams())

    _, found = found_of(ShapeParams(shape="round", pile=f"{yarns[0].name}=12mm loop"))
    assert (found.shape, found.binding, found.ends) == ("round", "overcast", (0, 0))
    assert found.edge == pytest.approx(math.pi * 0.5, rel=5e-3)
    assert (0.012, True) in [(pile.height, pile.loop) for pile in found.piles]
    assert sum(pile.knots for pile in found.piles) == pytest.approx(math.pi * 50**2, rel=5e-3)
    made, found = found_of(ShapeParams(kilim_ends=0.05, flat_weave="31-40/11-30"))
    assert (found.shape, found.edge, found.ends) == ("rectangle", 0, (0.05, 0.05))
    assert found.flat == pytest.approx(0.05 * 0.10)
    rows = np.array(woven_in_rows(made))
    assert rows.sum(axis=0).tolist() == [100**2 - 200, 2 * 10 * 100 + 200]
    assert rows[:10, 1].tolist() == [100] * 10


def test_carving_and_silk_are_in_the_price_and_in_the_papers(tmp_path: Path) -> None:
    """A field in two halves: 40 cm of lines; the silk has the mass of its knots by its own count."""
    Image.fromarray(np.repeat([[[158, 43, 37], [235, 220, 195]]], 2, axis=0).astype(np.uint8)).resize(
        (40, 40), Image.Resampling.NEAREST
    ).save(tmp_path / "halves.png")
    (tmp_path / "yarns.csv").write_text(
        "name,srgb,nm,ply,material\nwool red,#9e2b25,5,2,wool\nsilk ivory,#ebdcc3,10,2,silk\n", encoding="utf-8"
    )
    order = """customer = "N-7"
start = 2026-12-01
currency = "EUR"
language = "%s"
[price]
finishing = "12 EUR/m^2"
%s
[[order]]
name = "Halves"
picture = "halves.png"
size = "40x40cm"
quality = "10x10/dm"
yarns = "yarns.csv"
carve = "all"
due = 2027-03-01
"""
    costs = []
    for language, price in (("en", ""), ("tr", 'carving = "5 EUR/m"')):
        (tmp_path / "order.toml").write_text(order % (language, price), encoding="utf-8")
        done = run("order", tmp_path / "order.toml", "--out", tmp_path / language, "--json", "-")
        assert done.exit_code == 0, done.output
        (one,) = json.loads(done.output)["results"]["carpets"]
        costs.append(one["costs"]["finishing"])
        assert one["carving"]["length"] == pytest.approx(0.4, rel=0.07), one["carving"]
        assert [part["material"] for part in one["pile_fibres"]] == ["wool", "silk"]
        assert one["pile_fibres"][0]["share"] == pytest.approx(2 / 3, abs=0.015)  # thicker yarn goes a longer way
    rates = CostRates()
    assert costs[0] == pytest.approx(12 * 0.16 + rates.wage * one["carving"]["length"] / rates.carving_speed, abs=0.006)
    assert costs[1] == pytest.approx(12 * 0.16 + 5 * one["carving"]["length"], abs=0.006)
    quotation = text_of(tmp_path / "en" / "offer" / "quotation.pdf")
    assert "carved lines" in quotation
    assert "wool 68 %, silk 32 %" in quotation
    assert "oyulmuş çizgiler" in text_of(tmp_path / "tr" / "offer" / "quotation.pdf")


def test_a_colourway_exchanges_yarns_all_at_once() -> None:
    yarns = default_yarns()[:4]
    chart = Chart(np.random.default_rng(1).integers(0, 4, (20, 30)), yarns, "30x20cm", "10x10/dm", "symmetric")
    names = [yarn.name for yarn in yarns]
    swapped = recoloured(
        chart, Colourway("other", {names[0]: names[1], names[1]: names[0], names[2]: "grey"}), default_yarns()
    )
    shown = np.array([yarn.name for yarn in swapped.yarns])[swapped.knots]
    other = {names[0]: names[1], names[1]: names[0], names[2]: "grey", names[3]: names[3]}
    assert (shown == np.vectorize(other.get)(np.array(names)[chart.knots])).all()
    one = recoloured(chart, Colourway("one", {names[0]: names[1]}), ())
    assert one.colours == 3
    near = recoloured(chart, Colourway("near", {names[0]: default_yarns()[8].hex}), default_yarns())
    assert default_yarns()[8].name in {near.yarns[index].name for index in near.used}


def test_a_colour_that_the_shelf_lacks_is_named_with_the_nearest() -> None:
    chart = Chart([[0, 1], [1, 0]], default_yarns()[:2], "2x2cm", "10x10/dm", "symmetric")
    with pytest.raises(CarpetError) as error:
        recoloured(chart, Colourway("neon", {"madder red": "#00ff40"}), default_yarns())
    assert re.fullmatch(r"colourway 'neon' lacks the colour '#00ff40' for 'madder red'", error.value.given)
    assert re.fullmatch(r"take '[a-z ]+', the nearest: a colour difference of \d+\.\d", error.value.do)


def test_a_strike_off_has_as_many_colours_as_any_window(worked: tuple[dict[str, Any], Path]) -> None:
    chart = read_chart(worked[1] / "medallion-madder" / "chart.png")
    window = strike_off_window(chart, 0.08, 0.08)
    sample = part_of(chart, window)
    most = max(len(np.unique(chart.knots[top : top + 8, left : left + 8])) for top in range(33) for left in range(23))
    assert len(np.unique(sample.knots)) == most
    assert (sample.knots == chart.knots[window.top : window.top + 8, window.left : window.left + 8]).all()


def test_a_carpet_lies_in_its_room_as_a_homography_maps_it() -> None:
    marks = {
        "red": (0.15, 0.1),
        "lime": (0.85, 0.1),
        "blue": (0.15, 0.9),
        "yellow": (0.85, 0.9),
        "magenta": (0.6, 0.35),
    }
    carpet = Image.new("RGB", (400, 600), (128, 128, 128))
    for colour, (x, y) in marks.items():
        carpet.paste(Image.new("RGB", (16, 16), colour), (round(400 * x) - 8, round(600 * y) - 8))
    seen = np.asarray(draw_room(carpet, 2.0, 3.0).convert("HSV")).astype(int)
    assert seen.shape == (HIGH, WIDE, 3)
    hues = {"red": 0, "lime": 85, "blue": 170, "yellow": 42, "magenta": 212}
    middles = {}
    for colour, hue in hues.items():
        near = np.abs((seen[..., 0] - hue + 128) % 256 - 128) < 6
        rows, columns = np.nonzero(near & (seen[..., 1] > 225))
        middles[colour] = columns.mean(), rows.mean()
    equations, right = [], []
    for colour in ("red", "lime", "blue", "yellow"):
        (x, y), (u, v) = marks[colour], middles[colour]
        equations += [[x, y, 1, 0, 0, 0, -u * x, -u * y], [0, 0, 0, x, y, 1, -v * x, -v * y]]
        right += [u, v]
    h = np.append(np.linalg.solve(np.array(equations), np.array(right)), 1.0).reshape(3, 3)
    point = h @ (*marks["magenta"], 1.0)
    assert point[:2] / point[2] == pytest.approx(middles["magenta"], abs=1.5)


BAD = {
    "colourway": (('"indigo navy" = "light', '"indigo nayv" = "light'), "the design has no yarn 'indigo nayv'"),
    "discount": (('2 = "3%"', 'two = "3%"'), "'two' is no number of carpets"),
    "margin": (('margin = "30%"', "margin = 30"), "has no unit"),
    "wage": (('amount = "3.2 EUR"', 'amount = "3.2 USD"'), "another currency"),
    "sizes": (('size = "30x40cm"', 'sizes = "30x40cm"'), "are no sizes"),
    "language": (('customer = "N-204"', 'workshop_language = "xx"'), "'xx' is no language"),
    "twice": (('name = "indigo"', 'name = "madder"'), "two orders are named 'Medallion, madder'"),
}


def test_the_shelf_of_natural_dyes_has_its_card_and_the_lots_in_stock(tmp_path: Path) -> None:
    text = ORDER.replace('yarns = "wool"', 'yarns = "natural"').replace("indigo navy", "woad dark blue")
    order = written(tmp_path, text.replace('"light blue"', '"woad light blue"'))
    shelf = default_yarns("natural")
    stock = '\n[[yarn]]\nname = "madder red"\nstock = "1kg"\nlot = "K-114"\n'
    frames = (Path(ilmek.__file__).parent / "data" / "looms.toml").read_text()
    (tmp_path / "looms.toml").write_text(frames.replace("weavers = 3", "weavers = 4\nknots_a_day = 4000") + stock)
    done = run("order", order, "--looms", tmp_path / "looms.toml", "--out", tmp_path / "out", "--json", "-")
    assert done.exit_code == 0, done.output
    card = text_of(tmp_path / "out" / "offer" / "colour-card.pdf")
    for number, yarn in enumerate(shelf, 1):
        assert re.search(rf"\b{number} {yarn.name} {yarn.hex}", card), yarn.name
    assert "K-114" in card
    record = json.loads((tmp_path / "out" / "medallion-madder" / "record-1.json").read_text())["record"]
    lots = {yarn["name"]: yarn["lots"][0]["lot"] for yarn in record["yarn"]}
    assert lots["madder red"] == "K-114"
    assert {lot for name, lot in lots.items() if name != "madder red"} == {1}


def test_weavers_at_a_frame_tie_together(tmp_path: Path) -> None:
    order = written(tmp_path)
    frame = "weavers = 4\nknots_a_day = 4000\nwidth = '25cm'"
    frames = (Path(ilmek.__file__).parent / "data" / "looms.toml").read_text()
    (tmp_path / "looms.toml").write_text(frames.replace('weavers = 3\nwidth = "3.2m"', frame))
    done = run("plan", order, "--looms", tmp_path / "looms.toml", "--time-limit", "1s", "--json", "-")
    carpets = [carpet for entry in json.loads(done.stdout)["orders"] for carpet in entry["carpets"]]
    assert {carpet["loom"] for carpet in carpets} == {"2"}  # the other one is too narrow
    hours = 30 * 40 / (2 * 8000 / 8) / (1 - 0.03)
    assert all(carpet["weaving_time"] == math.ceil(60 * hours) * 60 for carpet in carpets)


@pytest.mark.parametrize("case", BAD)
def test_bad_orders_are_one_clear_error(case: str, tmp_path: Path) -> None:
    (old, new), expected = BAD[case]
    assert old in ORDER
    done = run("order", written(tmp_path, ORDER.replace(old, new, 1)), "--out", tmp_path / "out")
    assert done.exit_code == 2
    assert expected in done.output
    assert "order.toml, line" in done.output
    assert not (tmp_path / "out").exists()


def test_an_impossible_date_is_named_with_what_would_save_it(tmp_path: Path) -> None:
    late = written(tmp_path, ORDER.replace("due = 2026-12-31", "due = 2026-12-03"))
    done = run("order", late, "--out", tmp_path / "out", "--json", "-")
    assert done.exit_code == 3
    found = json.loads(done.stdout)
    assert any(not check["ok"] and "delay" in check["name"] for check in found["checks"])
    assert any(check["cure"] for check in found["checks"] if not check["ok"])
    assert (tmp_path / "out" / "offer" / "quotation.pdf").exists()


@pytest.mark.parametrize("words", [("verify", "no.json"), ("verify", "ilmek:2:a:b:c"), ("verify", "ilmek:1:aa:bb:-")])
def test_what_is_no_record_is_one_clear_error(words: tuple[str, ...], tmp_path: Path) -> None:
    done = run(*words, "--records", tmp_path)
    assert done.exit_code == 2
    assert done.output.count("\n") == 1


def test_a_key_is_for_its_owner_alone(worked: tuple[dict[str, Any], Path]) -> None:
    assert (worked[1].parent / "a.key").stat().st_mode & 0o077 == 0
    assert replace(WageRules(1.0), knots=10).rate(3) == pytest.approx(0.1)
