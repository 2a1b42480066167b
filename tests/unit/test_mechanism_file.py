"""What a mechanism file may say, and how each mistake in one is told: file, line, key."""

import json
from pathlib import Path

import pytest

from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError, OutputError
from ilmek.io.mechanism_file import (
    mechanism_json,
    mechanism_toml,
    parse_mechanism,
    read_mechanism,
    schema,
    write_mechanism,
)
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import Coupling

FOUR_BAR = """\
name = "four-bar"

[bodies.ground]
points = { A0 = [0, 0], B0 = ["300mm", 0] }
[bodies.crank]
points = { A0 = [0, 0], A = ["60mm", 0] }
mass = "200g"
centre = ["30mm", 0]
[bodies.coupler]
points = { A = [0, 0], B = ["20cm", 0] }
[bodies.rocker]
points = { B0 = [0, 0], B = ["0.23m", 0] }

[joints]
A0 = { pin = ["ground", "crank"] }
A = { pin = ["crank", "coupler"] }
B = { pin = ["coupler", "rocker"] }
B0 = { pin = ["ground", "rocker"] }

[inputs]
A0 = "crank"

[branches]
B = 1
"""


def test_units_at_the_edge():
    found = parse_mechanism(FOUR_BAR)
    assert found.mechanism == four_bar(0.3, 0.06, 0.2, 0.23, branch=+1)
    assert found.inertias["crank"].mass == 0.2
    assert found.inertias["crank"].centre == 0.03
    assert len(found.plan().steps) == 2


def test_slides_angles_and_pose():
    text = """
    [bodies]
    ground.points = { O = [0, 0], way = [0, 0] }
    bar.points.way = [0, 0]
    [joints]
    way = { slide = ["bar", "ground"], along = "90deg", turned = "-0.5turn" }
    [inputs]
    way = "bar"
    [pose.bar]
    origin = ["1cm", 0]
    angle = "180deg"
    """
    mechanism = parse_mechanism(text).mechanism
    slide = mechanism.joint("way")
    assert slide == type(slide)("way", "bar", "ground", 1.5707963267948966, -3.141592653589793)
    assert mechanism.pose == {"bar": (0.01, 3.141592653589793)}


MISTAKES = {
    "wrong type": (
        'A0 = [0, 0], B0 = ["300mm", 0]',
        "A0 = 3, B0 = [0, 0]",
        "line 4, bodies.ground.points.A0: 3 is not allowed here; position in the body's own frame",
    ),
    "wrong unit": (
        'B0 = ["300mm", 0]',
        'B0 = ["300deg", 0]',
        "line 4, bodies.ground.points.B0.0: '300deg' has the wrong",
    ),
    "no number": ('"60mm"', "true", "line 6, bodies.crank.points.A.0: true is not a quantity"),
    "not finite": ('"60mm"', "nan", "line 6, bodies.crank.points.A.0: nan is not a finite number"),
    "infinite": ('"60mm"', "-inf", "line 6, bodies.crank.points.A.0: -inf is not a finite number"),
    "one coordinate": ('["60mm", 0]', '["60mm"]', "line 6, bodies.crank.points.A: has 1 entry; 2: x and y"),
    "negative mass": ('"200g"', '"-1kg"', "line 5, bodies.crank: mass of a body is -1"),
    "zero length": ('["20cm", 0]', "[0, 0]", "line 9, bodies.coupler: link 'coupler' has zero length"),
    "unknown key": (
        "mass =",
        "weight =",
        "line 7, bodies.crank.weight: unknown key 'weight'; keys: points, length, between",
    ),
    "unknown table": (
        "[branches]",
        "[brnches]",
        "line 23, brnches: unknown key 'brnches'; keys: bodies, joints, inputs, $schema",
    ),
    "missing table": ("[inputs]", "[inputs2]", "line 1: has no 'inputs'"),
    "unknown body": ('["ground", "rocker"]', '["ground", "rockr"]', "line 18, joints.B0: four-bar has no body 'rockr'"),
    "unknown point": (
        "B0 = [0, 0], B =",
        "C0 = [0, 0], B =",
        "line 18, joints.B0: body 'rocker' of four-bar has no point",
    ),
    "unknown joint": ('A0 = "crank"', 'C = "crank"', "line 21, inputs.C: four-bar has no joint 'C'"),
    "wrong body driven": ('A0 = "crank"', 'A0 = "rocker"', "line 21, inputs.A0: input turns 'rocker' about 'A0'"),
    "no joint": ('{ pin = ["crank", "coupler"] }', '["crank"]', "line 16, joints.A: ['crank'] is not a table"),
    "neither": ('pin = ["crank"', 'pn = ["crank"', "line 16, joints.A: has none of pin, slide"),
    "joined to itself": (
        '["crank", "coupler"]',
        '["crank", "crank"]',
        "line 16, joints.A: joint 'A' of four-bar joins",
    ),
    "three bodies": (
        '["crank", "coupler"]',
        '["crank", "coupler", "rocker"]',
        "line 16, joints.A: body 'rocker' of four-bar has no point 'A'",
    ),
    "one body": ('["crank", "coupler"]', '["crank"]', "line 16, joints.A.pin: has 1 entry; 2 to 10: the bodies"),
    "no unit": ('"60mm"', "60", 'line 6, bodies.crank.points.A.0: 60 has no unit; write "60mm", or "60m"'),
    "text without unit": ('"60mm"', '"60"', "line 6, bodies.crank.points.A.0: '60' has no unit; write \"60mm\""),
    "metres for millimetres": ('"60mm"', '"60m"', "line 5, bodies.crank: A0-A of crank is 60000 mm and A-B of coupler"),
    "branch 2": ("B = 1\n", "B = 2\n", "line 24, branches.B: is 2; allowed: 1, -1"),
    "branch true": ("B = 1\n", "B = true\n", "line 24, branches.B: is true; allowed: 1, -1"),
    "body twice": ("[bodies.rocker]", "[bodies.crank]", "line 11, column 14: cannot declare"),
    "joint twice": ("A = { pin", "A0 = { pin", "line 16, column 36: cannot overwrite a value"),
    "not TOML": ('name = "four-bar"', "name = four", "line 1, column 8: invalid value"),
    "number of many digits": ("0.23", "9" * 400, "line 12, bodies.rocker.points.B.0: '999"),
}


@pytest.mark.parametrize(("before", "after", "said"), MISTAKES.values(), ids=MISTAKES.keys())
def test_a_mistake_is_told_with_its_line_and_key(before, after, said):
    assert before in FOUR_BAR
    with pytest.raises(MechanismError) as caught:
        parse_mechanism(FOUR_BAR.replace(before, after), name="beat.toml")
    assert f"beat.toml, {said}" in str(caught.value)


PLANLESS = {
    "no branch": ("B = 1\n", "", "line 17, joints.B: four-bar has no branch for the free pin 'B'"),
    "two inputs": ('A0 = "crank"', 'A0 = "crank"\nB0 = "rocker"', "the inputs crank, rocker drive 1 degree of freedom"),
    "no input": ('A0 = "crank"', "", "line 5, bodies.crank: four-bar is under-constrained at crank, coupler, rocker"),
    "zero dyad link": (
        'B = ["20cm", 0]',
        "B = [0, 0], C = ['1m', 0]",
        "line 9, bodies.coupler: link 'coupler' has zero length",
    ),
}


@pytest.mark.parametrize(("before", "after", "said"), PLANLESS.values(), ids=PLANLESS.keys())
def test_what_cannot_be_solved_is_told_with_its_line(before, after, said):
    with pytest.raises(MechanismError) as caught:
        parse_mechanism(FOUR_BAR.replace(before, after), name="beat.toml").plan()
    assert str(caught.value).startswith("beat.toml, line ")
    assert said in str(caught.value)


def test_json_tells_line_and_key_too():
    text = '{"bodies": {"ground": {"points": {}},\n "ground": {"points": {}}},\n"joints": {}, "inputs": {}}'
    with pytest.raises(MechanismError, match=r"^m.json, line 2, bodies.ground: is given twice; first given in line 1"):
        parse_mechanism(text, name="m.json", toml=False)
    with pytest.raises(MechanismError, match=r"^m.json, line 2, joints.A: has none of pin, slide"):
        parse_mechanism('{"bodies": {},\n"joints": {"A": {}}, "inputs": {}}', name="m.json", toml=False)
    with pytest.raises(MechanismError, match=r"^m.json, line 1, column 2: expecting property name"):
        parse_mechanism("{", name="m.json", toml=False)
    with pytest.raises(MechanismError, match=r"^m.json, line 1: \[\] is not a table"):
        parse_mechanism("[]", name="m.json", toml=False)
    with pytest.raises(MechanismError, match=r"nested too deeply"):
        parse_mechanism("[" * 100_000 + "]" * 100_000, name="m.json", toml=False)


FILES = {
    "gone.toml": (None, "does not exist"),
    "empty.toml": (b" \n", "is empty"),
    "latin.toml": (b"name = 'a'\n# \xff", "line 2 is not UTF-8"),
    "huge.json": (b" " * 1_000_001, "too large"),
    "other.yaml": (b"name: a", "ends in '.yaml'; a mechanism file is .toml or .json"),
}


@pytest.mark.parametrize("name", FILES)
def test_a_file_that_is_no_mechanism_file_is_refused(name: str, tmp_path: Path):
    content, said = FILES[name]
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(MechanismError, match=said) as caught:
        read_mechanism(tmp_path / name)
    assert str(caught.value).startswith(f"mechanism file {tmp_path / name} ")


@pytest.mark.parametrize("ending", ["toml", "json"])
def test_a_file_is_written_and_read_again(ending: str, tmp_path: Path):
    path = tmp_path / f"m.{ending}"
    mechanism = slider_crank(0.05, 0.2, offset=0.01, branch=-1)
    write_mechanism(path, OwnMachine(mechanism))
    assert read_mechanism(path).mechanism == mechanism
    with pytest.raises(OutputError):
        write_mechanism(tmp_path / "gone" / "m.toml", OwnMachine(mechanism))
    with pytest.raises(MechanismError, match="ends in '.txt'"):
        write_mechanism(tmp_path / "m.txt", OwnMachine(mechanism))


def test_a_file_may_name_its_schema():
    data = {"$schema": "x.json", "bodies": {"ground": {"points": {}}}, "joints": {}, "inputs": {}}
    assert parse_mechanism(json.dumps(data), toml=False).mechanism.moving == ()


def look(part, at="#"):
    yield at, part
    for key, inner in part.items() if isinstance(part, dict) else enumerate(part) if isinstance(part, list) else ():
        yield from look(inner, f"{at}/{key}")


def test_the_schema_holds_only_words_that_its_reader_knows():
    words = {
        *("$schema", "$id", "$defs", "$ref", "title", "description", "type", "required", "additionalProperties"),
        *("properties", "items", "minItems", "maxItems", "minimum", "maximum", "enum", "oneOf", "unit", "units"),
        *("exclusiveMinimum", "maxProperties", "propertyNames", "refers"),
    }
    places = dict(look(schema()))
    for at, part in places.items():
        if isinstance(part, dict) and not at.endswith(("/properties", "/$defs")):
            assert set(part) <= words, at
            if "$ref" in part:
                assert part["$ref"] in places


def test_couplings_are_read_with_their_units():
    text = """
    [bodies]
    ground.points = { O = [0, 0], way = [0, "-20mm"] }
    pinion.points.O = [0, 0]
    rack.points.way = [0, 0]
    [joints]
    O = { pin = ["ground", "pinion"] }
    way = { slide = ["rack", "ground"] }
    [couplings]
    teeth = { rack = ["pinion.O", "rack.way"], ratio = "20mm/rad", first_at = "90deg", second_at = "1cm" }
    [inputs]
    O = "pinion"
    """
    (coupling,) = parse_mechanism(text).mechanism.couplings
    assert coupling == Coupling("teeth", "rack", ("pinion", "O"), ("rack", "way"), 0.02, 1.5707963267948966, 0.01)
    mistakes = {
        '"20mm/rad"': ('"20mm"', "line 10, couplings.teeth.ratio: '20mm' has the wrong unit"),
        '"rack.way"': ('"rack.O"', "line 10, couplings.teeth: body 'rack' of mechanism has no point 'O'"),
        'second_at = "1cm"': ("second = 1", "line 10, couplings.teeth: has no 'second_at'"),
    }
    for before, (after, said) in mistakes.items():
        with pytest.raises(MechanismError) as caught:
            parse_mechanism(text.replace(before, after))
        assert said in str(caught.value)


def test_wheels_geared_in_a_circle_are_told_with_the_line_of_the_coupling_that_closes_it():
    text = """
    [bodies]
    ground.points = { A = [0, 0], B = ["1m", 0], C = [0, "1m"] }
    a.points.A = [0, 0]
    b.points.B = [0, 0]
    c.points.C = [0, 0]
    [joints]
    A = { pin = ["ground", "a"] }
    B = { pin = ["ground", "b"] }
    C = { pin = ["ground", "c"] }
    [couplings]
    ab = { gears = ["a.A", "b.B"], ratio = -1, first_at = 0, second_at = 0 }
    bc = { gears = ["b.B", "c.C"], ratio = -1, first_at = 0, second_at = 0 }
    ca = { gears = ["c.C", "a.A"], ratio = -1, first_at = 0, second_at = 0 }
    [inputs]
    A = "a"
    """
    said = "ring.toml, line 14, couplings.ca: mechanism is over-constrained at c; joints C and couplings bc, ca"
    with pytest.raises(MechanismError) as caught:
        parse_mechanism(text, name="ring.toml").plan()
    assert str(caught.value).startswith(said)


def test_an_unusual_ratio_of_lengths_is_confirmed_in_the_file():
    unusual = FOUR_BAR.replace('"60mm"', '"0.5mm"')
    with pytest.raises(MechanismError, match="A0-B0 of ground is 300 mm and A0-A of crank 0.5 mm: 600 to 1"):
        parse_mechanism(unusual)
    confirmed = parse_mechanism(f'confirm = ["lengths"]\n{unusual}')
    assert parse_mechanism(mechanism_toml(confirmed.machine)).mechanism == confirmed.mechanism


def test_plain_numbers_are_si_where_the_file_says_so():
    plain = FOUR_BAR.replace('"60mm"', "0.06")
    assert parse_mechanism(f'units = "SI"\n{plain}').mechanism == parse_mechanism(FOUR_BAR).mechanism
    with pytest.raises(MechanismError, match='0.06 has no unit; write "0.06mm", or "0.06m"'):
        parse_mechanism(plain)
    data = json.loads(mechanism_json(parse_mechanism(FOUR_BAR).machine))
    assert (data["units"], data["bodies"]["crank"]["points"]["A"]) == ("SI", [0.06, 0.0])


def test_toml_keeps_its_comments():
    text = f"# a comment\n{FOUR_BAR}"
    assert parse_mechanism(text).text == text


@pytest.mark.parametrize("page", ["reference/mechanism-files.md", "how-to/your-own-machine.md"])
def test_the_first_file_of_the_manual_can_be_solved(page: str):
    text = (Path(__file__).parents[2] / "docs" / page).read_text(encoding="utf-8")
    assert parse_mechanism(text.partition("```toml\n")[2].partition("```")[0]).plan().steps
