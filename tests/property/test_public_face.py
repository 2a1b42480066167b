"""Every argument of every public name: what means the same gives the same, anything else is an error of the package."""

import contextlib
import dataclasses
import inspect
import math
import pickle
import pydoc
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from public_calls import (
    BUILT,
    CALLS,
    NAMESPACES,
    Call,
    Count,
    FreeText,
    Kind,
    Named,
    Other,
    PointOf,
    PointsOf,
    Quantity,
    Samples,
)

import ilmek

INTEGERS = (np.int8, np.int16, np.int32, np.int64, np.uint8)
FLOATS = (np.float32, np.float64)
NO_NUMBER = (
    True,
    np.True_,
    1j,
    b"1",
    {"?": 1.0},
    object(),
    math.nan,
    math.inf,
    -math.inf,
    np.nan,
    10**400,
    1e300,
    "x",
    "nan",
)
NO_TEXT = (3, 1.5, [], {}, object(), b"x", np.zeros(2))


def test_every_public_name_has_a_call() -> None:
    called = {name.partition(".")[0].partition(" ")[0].partition("[")[0] for name in CALLS}
    assert set(ilmek.__all__) == (called | set(BUILT)) & set(ilmek.__all__)
    assert called <= set(ilmek.__all__)


# what may be given instead of a value, and what may not


def equals(kind: Kind) -> Iterator[tuple[Any, Any]]:
    """Pairs of a plain value and of another form of it."""
    for cls, forms in FORMS.items():
        if isinstance(kind, cls):
            yield from forms(kind)


def numbers(kind: Quantity) -> Iterator[tuple[Any, Any]]:
    for form in (np.float64, np.array, *((lambda v: f"{v!r}{kind.unit}",) if kind.unit else ())):
        yield kind.value, form(kind.value)
    for form in (int, Fraction, *INTEGERS, *FLOATS, lambda v: np.array(int(v))):
        yield float(kind.whole), form(kind.whole)


def rows(kind: Samples) -> Iterator[tuple[Any, Any]]:
    row = [kind.value, kind.value]
    for form in (row, tuple(row), [f"{kind.value!r}{kind.unit}", kind.value], np.array(row, object)):
        yield np.array(row), form
    for dtype in (*INTEGERS, *FLOATS):
        yield np.array([1.0, 2.0]), np.array([1, 2], dtype)


def vectors(kind: PointOf) -> Iterator[tuple[Any, Any]]:
    x, y = kind.value.real, kind.value.imag
    pairs = ((x, y), [x, y], (f"{x!r}{kind.unit}", f"{y!r}{kind.unit}"))
    arrays_ = () if kind.unit == "N" else (np.array([x, y]),)  # an array of forces has one per sample
    for form in (*pairs, *arrays_, np.complex128(kind.value), np.array(kind.value)):
        yield kind.value, form


def several(kind: PointsOf) -> Iterator[tuple[Any, Any]]:
    pairs = [(z.real, z.imag) for z in kind.value]
    texts = [(f"{x!r}m", f"{y!r}m") for x, y in pairs]
    for form in (list(kind.value), np.array(kind.value), np.array(pairs), pairs, [list(pair) for pair in pairs], texts):
        yield kind.value, form


FORMS: dict[type, Callable[[Any], Iterable[tuple[Any, Any]]]] = {
    Quantity: numbers,
    Samples: rows,
    PointOf: vectors,
    PointsOf: several,
    Count: lambda kind: [(kind.value, form(kind.value)) for form in (float, *INTEGERS[:4])],
    Named: lambda kind: [(kind.value, np.str_(kind.value))],
    FreeText: lambda kind: [(kind.value, np.str_(kind.value))],
    Other: lambda kind: [(kind.value, form) for form in kind.equal],
}
"""Other forms of a value by the kind of its argument."""


def refused(kind: Kind) -> Iterator[Any]:
    """Values that are an error for a kind of argument."""
    if isinstance(kind, Quantity):
        yield from NO_NUMBER
        yield from ("1kg" if kind.unit != "kg" else "1m", *(("5",) if kind.unit else ()))
        if isinstance(kind, Samples):
            yield from () if kind.gaps else (np.array([1.0, math.inf]), [1.0, math.nan])
            yield from (
                [1.0, None],
                ["1xy"],
                [[1.0], [1.0, 2.0]],
                np.array([True]),
                np.array([1j]),
                np.array([None, 1.0]),
                np.array(["x"]),
            )
        else:
            yield from ([], [1.0], (1.0, 2.0), np.array([1.0]), np.array([1.0, 2.0]))
    elif isinstance(kind, PointOf):
        yield from ((1.0,), (1.0, 2.0, 3.0), (1.0, None), (1.0, "1kg"), ("1", "2"), np.zeros((2, 3)))
        yield from (
            complex(math.nan, 0),
            complex(0, math.inf),
            math.nan,
            (math.nan, 0.0),
            {},
            object(),
            True,
            (True, 1),
        )
        yield from () if kind.unit == "N" else ([(1.0, 2.0)], np.zeros((1, 2)), np.zeros(3))
    elif isinstance(kind, PointsOf):
        rows = np.array([(z.real, z.imag) for z in kind.value])
        yield from (rows.T if len(rows) != 2 else 3, np.hstack((rows, rows)), rows * 1e6, rows.ravel().astype(bool))
        yield from ("x", 3, {}, object(), [1, None], [1, "x"], [(1, 2, 3)], [*kind.value[1:], math.nan], rows[None])
    elif isinstance(kind, Count):
        yield from (kind.value + 0.5, math.nan, math.inf, "x", [kind.value], 1j, True, object(), 10**12, -(10**12))
    elif isinstance(kind, Named):
        yield from (*NO_TEXT, f"{kind.value}x", "", "\0")
    elif isinstance(kind, FreeText):
        yield from NO_TEXT
    else:
        yield from (object(), {"?": object()}, *kind.wrong)


# outcomes


@contextlib.contextmanager
def noted(note: str) -> Iterator[None]:
    """Add a note to an error."""
    try:
        yield
    except Exception as error:
        error.add_note(note)
        raise


@dataclasses.dataclass(frozen=True)
class Refusal:
    """An error of the package."""

    message: str


def outcome(call: Call, arguments: Sequence[Any], named: Mapping[str, Any]) -> Any:
    """The result of a call, or its error of the package; any other error or warning passes on."""
    try:
        return call.function(*arguments, **named)
    except ilmek.IlmekError as error:
        return Refusal(str(error))


def same(first: Any, second: Any) -> bool:
    """Whether two results are equal in every number."""
    if isinstance(first, np.ndarray | float | int | complex):
        return np.array_equal(np.asarray(first), np.asarray(second), equal_nan=np.asarray(first).dtype.kind in "fc")
    if type(first) is not type(second) or isinstance(first, str | bytes):
        return type(first) is type(second) and bool(first == second)
    if isinstance(first, Mapping):
        return first.keys() == second.keys() and all(same(first[key], second[key]) for key in first)
    if isinstance(first, list | tuple):
        return len(first) == len(second) and all(map(same, first, second))
    if dataclasses.is_dataclass(first) and not isinstance(first, Refusal):
        return all(
            same(getattr(first, f.name), getattr(second, f.name)) for f in dataclasses.fields(first) if f.compare
        )
    return True  # two refusals, functions, or things without numbers


def plain(kind: Kind) -> Any:
    return kind.value


def variations(call: Call) -> Iterator[tuple[str, Kind, Callable[[Any], tuple[list[Any], dict[str, Any]]]]]:
    """Each argument: its name, its kind, and the arguments of the call with another value for it."""
    values = [plain(kind) for kind in call.positional]
    named = {name: plain(kind) for name, kind in call.named.items()}
    for index, kind in enumerate(call.positional):
        yield str(index), kind, lambda value, i=index: ([*values[:i], value, *values[i + 1 :]], named)
    for name, kind in call.named.items():
        yield name, kind, lambda value, name=name: (values, {**named, name: value})


def optional(call: Call, name: str, kind: Kind) -> bool:
    """Whether None stands for a default."""
    if isinstance(kind, Other):
        return kind.none
    parameters = list(inspect.signature(call.function).parameters.values())
    if name.isdigit():
        declared = parameters[min(int(name), len(parameters) - 1)]
    else:
        declared = inspect.signature(call.function).parameters.get(name, parameters[-1])
    return declared.default is None or call is CALLS["Forces.pin"]


@pytest.mark.parametrize("name", [name for name, call in CALLS.items() if not call.long])
@pytest.mark.one_in(2)
def test_the_same_value_in_another_form_gives_the_same(name: str) -> None:
    call = CALLS[name]
    valid = outcome(call, [plain(kind) for kind in call.positional], {key: plain(k) for key, k in call.named.items()})
    assert not isinstance(valid, Refusal) or name == "Forces.tooth", valid
    for argument, kind, with_value in variations(call):
        for value, form in equals(kind):
            arguments, named = with_value(value)
            expected = outcome(call, arguments, named)
            arguments, named = with_value(form)
            given = outcome(call, arguments, named)
            assert same(expected, given), (name, argument, value, form, expected, given)


@pytest.mark.parametrize("name", CALLS)
def test_a_wrong_value_is_an_error_of_the_package(name: str) -> None:
    call = CALLS[name]
    for argument, kind, with_value in variations(call):
        values = [*refused(kind), *(() if optional(call, argument, kind) else (None,))]
        for value in values:
            arguments, named = with_value(value)
            note = f"{name}, argument {argument} = {value!r}"
            with noted(note):
                given = outcome(call, arguments, named)
            assert isinstance(given, Refusal), f"{note}: accepted as {given!r}"
            assert "\n" not in given.message, given.message
            assert " object at 0x" not in given.message, given.message


@pytest.mark.parametrize("name", [name for name, call in CALLS.items() if not call.long])
def test_what_is_returned_goes_to_another_process(name: str) -> None:
    call = CALLS[name]
    made = outcome(call, [plain(kind) for kind in call.positional], {key: plain(k) for key, k in call.named.items()})
    copies = [pickle.loads(pickle.dumps(made))]
    if find_spec("distributed"):
        sent = import_module("distributed.protocol")
        copies.append(sent.deserialize(*sent.serialize(made)))
    assert all(same(made, again) and repr(made) == repr(again) for again in copies)


NUMBERS = st.none() | st.booleans() | st.integers() | st.floats() | st.complex_numbers() | st.text(max_size=8)
ARRAYS = arrays.arrays(
    st.sampled_from([np.int8, np.int64, np.uint8, np.float32, np.float64, np.complex128, bool]),
    arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=3),
)
ANYTHING = st.recursive(
    NUMBERS | ARRAYS,
    lambda inner: st.lists(inner, max_size=3) | st.tuples(inner, inner) | st.dictionaries(st.text(max_size=3), inner),
    max_leaves=5,
)
SHORT = [name for name, call in CALLS.items() if not call.long and call.positional and name != "forward_dynamics"]


@settings(max_examples=max(200, settings.default.max_examples))
@given(name=st.sampled_from(SHORT), data=st.data())
def test_any_value_gives_a_result_or_an_error_of_the_package(name: str, data: st.DataObject) -> None:
    call = CALLS[name]
    _, _, with_value = data.draw(st.sampled_from(list(variations(call))))
    arguments, named = with_value(data.draw(ANYTHING))
    outcome(call, arguments, named)


# help texts

LONGEST_PARAMETER, LONGEST_CALL, LONGEST_RECORD = 100, 560, 1040
"""Characters of a parameter in the signature of a function, of its whole signature, and of that of a record."""


VERBS_AND_RECORDS = [name for name in ilmek.__all__ if name not in NAMESPACES]


@pytest.mark.parametrize("name", VERBS_AND_RECORDS)
def test_help_is_readable(name: str) -> None:
    public = getattr(ilmek, name)
    text = pydoc.plain(pydoc.render_doc(public))
    assert " at 0x" not in text
    if inspect.isfunction(public):
        signature = inspect.signature(public)
        assert max((len(str(parameter)) for parameter in signature.parameters.values()), default=0) <= LONGEST_PARAMETER
        assert len(str(signature)) <= LONGEST_CALL
    assert max(map(len, text.splitlines())) <= LONGEST_RECORD


@pytest.mark.parametrize("name", VERBS_AND_RECORDS)
def test_help_has_an_example(name: str) -> None:
    assert ">>> " in (getattr(ilmek, name).__doc__ or "")


def test_the_default_progress_is_pickled_and_prints_short() -> None:
    again = pickle.loads(pickle.dumps(ilmek.Progress(stage="chart")))
    assert again == ilmek.Progress(stage="chart")
    assert repr(again) == "Progress(stage='chart')"


def test_all_of_units_are_factors_and_functions_of_more_than_a_letter() -> None:
    names: dict[str, object] = {}
    exec("from ilmek.units import *", names)
    given = {name: value for name, value in names.items() if name != "__builtins__"}
    assert {"mm", "deg", "rpm", "parse_quantity"} <= set(given)
    assert not [
        name for name in given if len(name) == 1 or not (isinstance(given[name], float) or callable(given[name]))
    ]
    assert all(getattr(given[name], "__module__", "ilmek.units") == "ilmek.units" for name in given)
