"""Measured curves beside a model: curves made here by circles and by hand, fits against those of another method."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from ilmek.cli import main
from ilmek.num.least_squares import fitted
from ilmek.units import deg, mm


def needle_height(angle: float, crank: float) -> float:
    """Height of the needle's end [mm] by circles cut with circles: the paper's Table 1 with another crank."""
    coupler, rocker, arm, rod = 138.0, 115.0, 125.0, 120.0
    pin, shaft = crank * np.exp(1j * angle), 70 + 155j
    reach = abs(shaft - pin)
    turned = math.acos((coupler**2 + reach**2 - rocker**2) / (2 * coupler * reach))
    joint = pin + coupler * (shaft - pin) / reach * np.exp(1j * turned)
    end = shaft + arm * (joint - shaft) / rocker * np.exp(1j * math.radians(168))
    return float(end.imag - math.sqrt(rod**2 - (170 - end.real) ** 2))


def measured(path: Path, crank: float = 15.0, *, late: float = 0.0, noise: float = 0.0) -> Path:
    angles = np.arange(0, 360, 4.0)
    heights = np.array([needle_height((angle - late) * deg, crank) for angle in angles])
    heights += np.random.default_rng(5).normal(0, noise, heights.size) - heights.min()
    rows = "\n".join(f"{angle:g}; {height:.9f}" for angle, height in zip(angles, heights, strict=True))
    path.write_text(f"# stand 1\ncrank angle [deg]; needle [mm]\n{rows}\n")
    return path


def run(path: Path, *more: str) -> tuple[int, dict, str]:
    out = path.with_suffix(".json")
    result = CliRunner().invoke(main, ["compare", str(path), "tufting", *more, "--json", str(out), "--force"])
    return result.exit_code, json.loads(out.read_text()) if result.exit_code in {0, 3} else {}, result.output


def test_the_model_and_a_construction_by_circles_differ_by_the_sampling_alone(tmp_path: Path) -> None:
    code, data, _ = run(measured(tmp_path / "a.csv"), "--within", "0.1%")
    (curve,) = data["compared"]
    assert code == 0
    assert curve["samples"] == 90
    assert curve["rms"] < 0.02 * mm
    assert curve["model_max"] == pytest.approx(curve["measured_max"], abs=0.02 * mm)


def test_a_longer_crank_is_found_again(tmp_path: Path) -> None:
    path = measured(tmp_path / "a.csv", 16.0)
    code, data, _ = run(path, "--within", "1%")
    assert code == 3
    assert data["compared"][0]["rms"] > 0.5 * mm
    code, data, _ = run(path, "--fit", "crank", "--within", "1%", "--report", str(tmp_path / "a.html"))
    assert code == 0
    assert data["fitted"]["crank"]["before"] == pytest.approx(15 * mm)
    assert data["fitted"]["crank"]["value"] == pytest.approx(16 * mm, abs=0.02 * mm)
    assert "model, fitted" in (tmp_path / "a.html").read_text()


def test_a_shifted_encoder_is_found(tmp_path: Path) -> None:
    code, data, _ = run(measured(tmp_path / "a.csv", late=12.0, noise=0.05), "--align", "--fit", "crank")
    found = data["fitted"]
    assert code == 0
    assert found["shift"]["value"] / deg == pytest.approx(-12, abs=4 * found["shift"]["deviation"] / deg + 0.05)
    assert found["crank"]["value"] == pytest.approx(15 * mm, abs=4 * found["crank"]["deviation"] + 0.02 * mm)
    assert data["parameters"]["crank"] == pytest.approx(15 * mm)


def test_values_and_deviations_are_those_of_a_fitted_line() -> None:
    """Closed form of linear regression, by the covariance of numpy's polynomial fit."""
    x = np.linspace(0, 3, 40)
    y = 2 - 0.7 * x + np.random.default_rng(2).normal(0, 0.1, 40)
    found = fitted(lambda p: y - p[0] - p[1] * x, np.array([1.0, 1.0]), (np.full(2, -9.0), np.full(2, 9.0)))
    line, covariance = np.polyfit(x, y, 1, cov=True)
    assert found.values[::-1] == pytest.approx(line, rel=1e-6)
    assert found.deviations[::-1] == pytest.approx(np.sqrt(np.diag(covariance)), rel=1e-4)
    flat = fitted(lambda p: y - p[0] + 0 * p[1], np.ones(2), (np.full(2, -9.0), np.full(2, 9.0)))
    assert np.isinf(flat.deviations[1])


@pytest.mark.parametrize(
    ("text", "more", "words"),
    [
        ("angle [deg], needle [kg]\n0, 1\n1, 2\n2, 3\n", (), "is no curve of tufting"),
        ("angle [deg], nedle [mm]\n0, 1\n1, 2\n2, 3\n", (), "needle-height: needle [mm]"),
        ("angle [deg], needle [mm]\n0, 1\n1, x\n2, 3\n", (), "line 3: needle is 'x'"),
        ("angle [deg], needle [mm]\n0, 1\n1, 2\n", (), "2 samples"),
        ("angle [deg]\n0\n", (), "names 1 column"),
        ("angle [deg], needle [m[m]\n0, 1\n", (), "heading"),
        ("angle [deg], needle [mm]\n0, 1\n1, 2\n2, 3\n", ("--fit", "cranc"), "crank"),
        ("angle [deg], needle [mm]\n0, 1\n1, 2\n2, 3\n", ("--fit", "bars"), "no number in force"),
        ("angle [deg], needle [mm]\n0, 1\n1, 2\n2, 3\n", ("--within", "5mm"), "5mm"),
        ("", (), "is empty"),
    ],
)
def test_bad_input_is_one_clear_error(tmp_path: Path, text: str, more: tuple[str, ...], words: str) -> None:
    path = tmp_path / "a.csv"
    path.write_text(text)
    code, _, output = run(path, *more)
    assert code == 2
    assert words in output
    assert "Traceback" not in output
