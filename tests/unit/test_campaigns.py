"""Shares of the campaigns: none is left out for ever, a seed repeats its cases. Phases run side by side."""

import re
from pathlib import Path

import pytest
from campaigns import PARTS, ROOT, SHARES, chosen, lawful, rotated, seed_of_the_commit
from phases import Phase, run, table
from processes import ended, printed, python


def test_three_commits_in_a_row_run_every_part_that_has_a_share() -> None:
    able = {part.name for part in PARTS if not part.whole}
    for seed in (0, 1, 1310):
        names = [part.name for commit in range(3) for part in chosen([], seed + commit, True)]
        assert sorted(names) == sorted(able)
    assert [part.name for part in chosen([], 7, False)] == [part.name for part in PARTS]


def test_shares_of_seeds_in_a_row_have_every_file_once() -> None:
    paths = [f"tests/test_{index}.py" for index in range(20)]
    assert sorted(path for seed in range(5, 5 + SHARES) for path in rotated(paths, seed, True)) == sorted(paths)
    assert rotated(paths, 3, False) == paths


def test_each_part_states_its_seed() -> None:
    for part in PARTS:
        run_of_seven, run_of_eight = part.run(7, True), part.run(8, True)
        assert run_of_seven != run_of_eight, part.name
        assert run_of_seven == part.run(7, True), part.name


def test_every_property_and_every_left_out_case_is_in_the_campaign() -> None:
    listed = {path.name for path in lawful(ROOT / "tests")}
    assert {"test_knot_homotopy.py", "test_linkage_campaign.py", "test_design_invariants.py"} <= listed
    texts = {path.name: path.read_text(encoding="utf-8") for path in (ROOT / "tests").glob("[!b]*/test_*.py")}
    marked = {name for name, text in texts.items() if "\n@pytest.mark.one_in(" in text} - {Path(__file__).name}
    assert "test_page_structure.py" in marked
    assert marked <= listed


def test_the_seed_of_a_commit_is_the_same_again() -> None:
    assert seed_of_the_commit() == seed_of_the_commit() > 0


def test_a_part_that_is_not_there_is_an_error() -> None:
    refused = ended(python("-m", "campaigns", "kill"))
    assert refused.returncode == 2
    assert "no part kill; parts: laws, fuzz" in refused.stderr


def test_make_test_tries_the_same_cases_each_time_and_a_campaign_others() -> None:
    script = "import effort; print(effort.number(3, 50), effort.seeds(2, 3), effort.examples(60).max_examples)"
    said = [printed(python("-c", script), changes={"ILMEK_CAMPAIGN": seed}) for seed in (None, "0", "1")]
    assert said == ["3 range(0, 2) 20\n", "50 range(1000, 1003) 60\n", "50 range(2000, 2003) 60\n"]


def test_phases_run_side_by_side_and_after_a_failure(capfd: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    rules = ("waits:\n\t@read line < pipe && echo $$line", "feeds:\n\t@echo fed > pipe", "fails:\n\t@echo bad; exit 3")
    (tmp_path / "makefile").write_text("\n".join((*rules, "last:\n\t@echo late\n")))
    make = ("make", "--no-print-directory", "-C", str(tmp_path))
    ended(["mkfifo", str(tmp_path / "pipe")])
    phases = run([["waits"], ["feeds", "fails", "last"]], make)
    ends = {phase.name: phase.status == 0 for phase in phases}
    assert ends == {"waits": True, "feeds": True, "fails": False, "last": True}
    shown = capfd.readouterr().out
    assert "waits        | fed" in shown
    assert "fails        | bad" in shown
    assert "last         | late" in shown


def test_the_table_has_the_seconds_of_each_phase() -> None:
    shown = table([Phase("lint", 0, 2.4, ("fine",)), Phase("unit", 1, 181.0, ("FAILED a",))], 182.0, 350.0)
    assert shown.splitlines()[0] == "FAILED a"
    assert re.search(r"^lint +2 s$", shown, re.MULTILINE)
    assert re.search(r"^unit +181 s  FAILED$", shown, re.MULTILINE)
    assert re.search(r"^all +182 s; 350 s of processor time", shown, re.MULTILINE)


MATRIX = """
import pytest

@pytest.mark.matrix(light=3)
@pytest.mark.parametrize("number", range(10))
def test_many(number):
    print(f"case {number}")

@pytest.mark.one_in(4)
@pytest.mark.parametrize("number", range(10))
def test_shared_out(number):
    print(f"part {number}")
"""


@pytest.mark.parametrize(("seed", "cases"), [(None, [0, 4, 9]), ("5", list(range(10)))])
def test_a_matrix_has_some_of_its_cases_in_make_test_and_all_in_a_campaign(
    tmp_path: Path, seed: str | None, cases: list[int]
) -> None:
    (tmp_path / "conftest.py").write_text((ROOT / "tests" / "conftest.py").read_text(encoding="utf-8"))
    (tmp_path / "test_matrix.py").write_text(MATRIX)
    command = python("-m", "pytest", "-q", "-s", "-p", "no:cacheprovider", "--rootdir", tmp_path, tmp_path)
    shown = printed(command, cwd=tmp_path, changes={"ILMEK_CAMPAIGN": seed})
    assert [int(number) for number in re.findall(r"case (\d)", shown)] == cases
    part = [int(number) for number in re.findall(r"part (\d)", shown)]
    assert part == (list(range(10)) if seed else list(range(part[0], 10, 4)))
