"""Drafts in WIF, written here by plain loops from a drawdown that is known: what is read is that drawdown."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from ilmek.carpet.chart import Chart
from ilmek.cli import main
from ilmek.errors import LoomError
from ilmek.io.chart.formats import FORMATS
from ilmek.io.draft_file import read_draft
from ilmek.io.yarn_file import default_yarns


def draft_text(rng: np.random.Generator, *, plan: bool, sinking: bool) -> tuple[str, np.ndarray, np.ndarray]:
    """A draft at random with several shafts on a warp and treadles on a pick; its drawdown and its colours."""
    shafts, treadles, warps, picks = (int(number) for number in rng.integers(2, 9, 4))
    on = [sorted({int(one) for one in rng.integers(1, shafts + 1, rng.integers(1, 3))}) for _ in range(warps)]
    tied = [sorted({int(one) for one in rng.integers(1, shafts + 1, rng.integers(0, 4))}) for _ in range(treadles)]
    trod = [sorted({int(one) for one in rng.integers(1, treadles + 1, rng.integers(1, 3))}) for _ in range(picks)]
    lifted = [sorted({shaft for treadle in pick for shaft in tied[treadle - 1]}) for pick in trod]
    up = np.zeros((picks, warps), dtype=bool)
    for pick in range(picks):
        for warp in range(warps):
            up[pick, warp] = (len(set(on[warp]) & set(lifted[pick])) > 0) != sinking
    palette = rng.integers(0, 1000, (3, 3))
    which = rng.integers(0, 3, warps)
    lines = ["; by a program with comments", "[wif]", "VERSION=1.1", "[Weaving]", f"shafts={shafts}"]
    lines += [f"Treadles={treadles}", f"Rising Shed={'no' if sinking else 'yes'}", "[COLOR PALETTE]", "Range=0,999"]
    lines += ["[Color Table]", *(f"{n}={r},{g},{b}" for n, (r, g, b) in enumerate(palette.tolist(), 1))]
    lines += ["[WARP]", f"Threads={warps}", "Color=1", "Units=Inches", "Spacing=0.05"]
    lines += ["[WEFT]", f"Threads={picks}", "Color=2", "Units=decipoints", "Spacing=72"]
    lines += ["[WARP COLORS]", *(f"{n}={colour + 1}" for n, colour in enumerate(which.tolist(), 1))]

    def listed(name: str, rows: list[list[int]]) -> list[str]:
        return [f"[{name}]", *(f"{n}={','.join(map(str, row)) or '0'}" for n, row in enumerate(rows, 1))]

    lines += listed("THREADING", on)
    lines += listed("LIFTPLAN", lifted) if plan else [*listed("TIEUP", tied), *listed("TREADLING", trod)]
    return "\r\n".join(lines) + "\r\n", up, np.rint(palette[which] * 255 / 999)


@pytest.mark.parametrize("seed", range(24))
def test_a_draft_of_another_program_is_read(tmp_path: Path, seed: int) -> None:
    text, up, colours = draft_text(np.random.default_rng(seed), plan=seed % 2 == 1, sinking=seed % 3 == 1)
    (tmp_path / "a.WIF").write_text(text, encoding="ascii", newline="")
    draft = read_draft(tmp_path / "a.WIF")
    assert np.array_equal(draft.up, up)
    assert np.array_equal(draft.warp, colours)
    assert (draft.warp_pitch, draft.weft_pitch) == pytest.approx((0.00127, 0.00254))
    runs = ["".join("#" if one else " " for one in column).split() for column in up.T]
    assert draft.warp_float == max((len(run) for column in runs for run in column), default=0)
    assert np.array_equal(draft.face[up], np.broadcast_to(colours, (*up.shape, 3))[up])


def test_the_ground_weave_of_a_chart_is_plain(tmp_path: Path) -> None:
    chart = Chart(np.zeros((7, 9), int), default_yarns()[:1], "9x7cm", "10x10/dm", "symmetric")
    FORMATS["wif"].save(tmp_path / "ground.wif", chart)
    done = CliRunner().invoke(main, ["inspect", str(tmp_path / "ground.wif")])
    assert done.exit_code == 0
    assert "plain weave" in done.output
    assert "14 picks" in done.output
    found = json.loads(CliRunner().invoke(main, ["inspect", str(tmp_path / "ground.wif"), "--json", "-"]).output)
    assert found["plain"]
    assert [len(line) for line in found["up"]] == 14 * [found["warps"]]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[wif]", "[wiff]", r"no section \[WIF\]"),
        ("[wif]", "wif", "no WIF file"),
        ("Threads=", "Thread=", r"\[WARP\] has no key Threads"),
        ("[THREADING]\r\n1=", "[THREADING]\r\n1=77,", "a whole number, 0 to"),
        ("[THREADING]", "[THREADED]", r"no section \[THREADING\]"),
        ("Color=2", "Color=9", r"no colour '9'"),
        ("Range=0,999", "Range=0,9", "a whole number, 0 to 9"),
        ("shafts=", "shafts=-", "a whole number, 1 to 1000"),
    ],
)
def test_a_bad_draft_is_one_clear_error(tmp_path: Path, old: str, new: str, message: str) -> None:
    text, _, _ = draft_text(np.random.default_rng(1), plan=False, sinking=False)
    assert old in text
    (tmp_path / "a.wif").write_text(text.replace(old, new), encoding="ascii", newline="")
    with pytest.raises(LoomError, match=message):
        read_draft(tmp_path / "a.wif")
    done = CliRunner().invoke(main, ["inspect", str(tmp_path / "a.wif")])
    assert done.exit_code == 2
    assert "Traceback" not in done.output
