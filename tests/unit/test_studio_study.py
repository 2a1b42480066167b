"""A study from a page of the studio: its designs are those of the command line."""

import shlex
import tomllib

import pytest
from click.testing import CliRunner
from study_targets import FOUR_BAR

from ilmek.cli import main
from ilmek.errors import ParameterError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.study import StudyRequest, VariedNumber, numbers, studied

SWING = {"swing": "28deg..34deg"}


def test_the_designs_of_a_page_are_those_of_its_command() -> None:
    """A setting that varies is no longer fixed."""
    request = StudyRequest(
        "beat-up", {"speed": "14rad/s", "swing": "30deg"}, vary=SWING, goals=("beater_stroke",), samples=3
    )
    found = studied(request, Context())
    assert (found.samples, found.made, [one["swing"] for one in found.designs]) == (
        3,
        3,
        ["28deg", "31.000000000000004deg", "34deg"],
    )
    cloud = found.figures[0].cloud
    assert cloud is not None
    table = CliRunner().invoke(main, [*shlex.split(found.command)[1:], "--csv", "-"]).stdout.splitlines()[1:]
    rows = [[float(cell) for cell in line.split(",")[:2]] for line in table]
    assert rows == [pytest.approx(pair, rel=1e-5) for pair in zip(*cloud.values, strict=True)]


def test_what_can_vary_has_a_range_about_its_value_within_its_bounds() -> None:
    found = numbers(StudyRequest(mechanism=tomllib.loads(FOUR_BAR)), Context())
    assert found.varied[0] == VariedNumber("a", "54mm..66mm")
    assert "drive_torque_max" in found.results
    ranges = {one.name: one.range for one in numbers(StudyRequest("cam"), Context()).varied}
    assert ranges["lift"].endswith("mm")
    assert all(".." in text or not text for text in ranges.values())


def test_bad_studies_of_a_page_are_one_error() -> None:
    with pytest.raises(ParameterError, match="5000 designs; 1 to 4096"):
        studied(StudyRequest("cam", vary={"lift": "20mm..30mm"}, samples=5000), Context())
    with pytest.raises(ParameterError, match="did you mean 'swing'"):
        studied(StudyRequest("beat-up", vary={"swinge": "28deg..34deg"}), Context())
