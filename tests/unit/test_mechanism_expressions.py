"""Quantities of a mechanism file: units, named values, expressions; errors name the text and what is allowed."""

import math

import pytest

from ilmek.errors import IlmekError, MechanismError
from ilmek.io.mechanism.expressions import DEEPEST_EXPRESSION, FUNCTIONS, LONGEST_EXPRESSION
from ilmek.io.mechanism.values import MOST_VALUES, named_values
from ilmek.io.schema import SourceText

SOURCE = SourceText("a.toml", {(): 1})
VALUES = named_values(
    {"l": "4 r", "r": "40mm", "q": "l/2 + 10 mm", "tilt": "30deg", "n": 3, "größe": "1m"}, SOURCE, si=False
)

GOOD = {
    "60mm": ("m", 0.06),
    "-1.5e1 mm": ("m", -0.015),
    "r": ("m", 0.04),
    "-r": ("m", -0.04),
    "q": ("m", 0.09),
    "2*r + 5mm": ("m", 0.085),
    "2 r": ("m", 0.08),
    "2(r + l)": ("m", 0.4),
    "sqrt(r^2 + (3r/4)^2)": ("m", 0.05),
    "hypot(30mm, r)": ("m", 0.05),
    "max(r, l, 1cm)": ("m", 0.16),
    "abs(r - l)": ("m", 0.12),
    "r*cos(2*tilt)": ("m", 0.02),
    "größe/n": ("m", 1 / 3),
    "atan2(r, r)": ("rad", math.pi / 4),
    "asin(1/2)": ("rad", math.pi / 6),
    "pi/2*rad": ("rad", math.pi / 2),
    "-20/n": ("1", -20 / 3),
    "5%": ("1", 0.05),
    "2^-2": ("1", 0.25),
    "7850kg/m^3": ("kg/m^3", 7850.0),
    "0.2kg*r^2": ("kg*m^2", 0.00032),
    "2 N*m": ("N*m", 2.0),
    "20mm/rad": ("m/rad", 0.02),
    "r - r": ("m", 0.0),
}


@pytest.mark.parametrize("text", GOOD)
def test_a_quantity_is_a_number_with_a_unit_or_an_expression(text: str) -> None:
    unit, value = GOOD[text]
    assert VALUES.quantity(text, (unit,)).value == pytest.approx(value, rel=1e-15, abs=1e-16)


BAD = {
    "140": 'no unit; write "140mm", or "140m"',
    "300deg": "'300deg' has the wrong unit; a quantity in m is required",
    "r*r": "'r*r' is m^2; a quantity in m is required",
    "r + 1": "joins m and a plain number by +",
    "hypot(r, 1)": "joins m and a plain number by hypot",
    "mm": "'mm' is a unit without a number; write it like 60mm",
    "60mn": "unknown name 'mn'; a value of [values], a unit, pi or a function",
    "grösse": "did you mean 'größe'?",
    "1/2 r": "is ambiguous at 'r'; write * or parentheses there",
    "sqrt(r)": "takes the root of m",
    "sin(r)*r": "gives sin m; an angle, like 30deg",
    "sin(1)*r": "gives sin a plain number; an angle, like 30deg",
    "sqrt(r, r)": "gives 2 numbers to sqrt; 1 to 1",
    "r/(n - 3)": "divides by 0",
    "r*0^-1": "divides by 0",
    "r^1.5": "has a power that is not allowed; whole numbers up to 12",
    "r^13": "has a power that is not allowed",
    "2^2^2": "has a power of a power",
    "(r^12)^2": "too high a power of a unit; at most 12",
    "10^12*10^12*10^12*r": "has no finite value; at most 1e+30 in every step",
    "(10^12)^12*r": "has no finite value",
    "sqrt(0 - 1)*r": "has no finite value",
    "acos(2)*r": "has no finite value",
    "": "is incomplete",
    "(r": "is incomplete",
    "r r": "is incomplete at 'r'",
    "r,": "is incomplete at ','",
    "r.real": "is incomplete at '.'",
    "__import__('os')": "unknown name '__import__'",
    "[r for r in r]": "is incomplete at '['",
    "(" * 50 + "r" + ")" * 50: f"is nested too deeply; at most {DEEPEST_EXPRESSION} levels",
    "-" * 50 + "r": f"is nested too deeply; at most {DEEPEST_EXPRESSION} levels",
    "r" + "+r" * 100: f"is too long; at most {LONGEST_EXPRESSION} characters",
    "1e40mm": "is too large a number",
}


@pytest.mark.parametrize("text", BAD, ids=[text[:24] or "empty" for text in BAD])
def test_an_expression_that_is_no_length_is_an_error(text: str) -> None:
    with pytest.raises(IlmekError) as caught:
        VALUES.quantity(text, ("m",))
    assert BAD[text] in str(caught.value)


@pytest.mark.parametrize(("value", "unit"), [(140, "m"), (1.5, "rad"), (3, "kg"), (2, "N"), (1, "s")])
def test_only_0_and_plain_numbers_need_no_unit(value: float, unit: str) -> None:
    with pytest.raises(IlmekError, match="has no unit; write"):
        VALUES.quantity(value, (unit,))
    assert VALUES.quantity(0, (unit,)).value == 0
    assert VALUES.quantity("0", (unit,)).value == 0
    assert VALUES.quantity(value, ("1",)).value == value
    assert named_values({}, SOURCE, si=True).quantity(value, (unit,)).value == value


def test_a_quantity_of_several_dimensions_states_its_own() -> None:
    assert VALUES.quantity("90deg", ("rad", "m")).unit == "rad"
    assert VALUES.quantity("2 r", ("rad", "m")).unit == "m"
    assert VALUES.quantity(0, ("rad", "m")) == (0.0, "")
    with pytest.raises(IlmekError, match="is kg; a quantity in rad or a quantity in m is required"):
        VALUES.quantity("1kg*n", ("rad", "m"))


WRONG_VALUES = {
    "circle": (
        {"a1": "b1", "b1": "c1 + a1", "c1": "1mm"},
        "values.b1: the values a1 -> b1 -> a1 depend on one another",
    ),
    "itself": ({"a1": "2 a1"}, "the values a1 -> a1 depend on one another"),
    "unit": ({"m": "3kg"}, "'m' is a unit; choose another name, like m1"),
    "function": ({"sin": 1}, "'sin' is a function or constant"),
    "blank": ({"a b": 1}, "'a b' is not a name"),
    "list": ({"a1": [1]}, "values.a1: [1] is not a quantity"),
    "many": ({f"a{n}": 1 for n in range(MOST_VALUES + 1)}, f"has {MOST_VALUES + 1} values; at most {MOST_VALUES}"),
    "no table": ([1], "[1] is not a table"),
}


@pytest.mark.parametrize("name", WRONG_VALUES)
def test_values_that_cannot_be_are_an_error(name: str) -> None:
    texts, said = WRONG_VALUES[name]
    source = SourceText("a.toml", {(): 1, **{("values", key): 2 for key in texts if isinstance(key, str)}})
    with pytest.raises(MechanismError) as caught:
        named_values(texts, source, si=False)
    assert said in str(caught.value)
    assert str(caught.value).startswith("a.toml, line ")


def test_a_long_chain_of_values_is_evaluated_in_any_order() -> None:
    chain = {f"a{n}": f"a{n + 1} + 1mm" for n in range(MOST_VALUES - 1)} | {f"a{MOST_VALUES - 1}": "1mm"}
    assert named_values(chain, SOURCE, si=False).known["a0"].value == pytest.approx(MOST_VALUES / 1000)


def test_functions_are_listed_in_the_manual(request: pytest.FixtureRequest) -> None:
    manual = request.config.rootpath / "docs" / "reference" / "mechanism-files.md"
    text = manual.read_text(encoding="utf-8")
    assert [name for name in FUNCTIONS if f"`{name}`" not in text] == []
