"""`ilmek mcp`: messages of the Model Context Protocol over standard input, and what its tools answer."""

import json
import math
from pathlib import Path
from typing import Any

import pytest
from processes import ilmek, printed

from ilmek.api.tools import TOOLS, call_tool
from ilmek.errors import IlmekError

EXAMPLES = Path(__file__).parents[2] / "examples"
OPENING = {"protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": {"name": "test", "version": "1"}}
TURKISH = ((1, 3), (1, -2), (-1, -2), (-1, 2), (3, 2), (3, -2), (1, -2), (1, 3))
PRESS = (EXAMPLES / "slider_crank_press.toml").read_text(encoding="utf-8")
CALLS: dict[str, dict[str, Any]] = {
    "machines": {},
    "parameters": {"name": "cam"},
    "design": {"name": "cam", "settings": {"lift": "30mm"}},
    "study": {"target": "cam", "vary": {"lift": "20mm, 30mm"}, "record": ["prime_radius"]},
    "judge": {"mechanism": "quick_return.toml"},
    "run": {"mechanism": "slider_crank_press.toml", "values": {"stroke": "50mm"}, "speed": "60rpm"},
    "knot": {"points": [[0.001 * x, 0.001 * y] for x, y in TURKISH]},
    "cyclogram": {"name": "weaver"},
}
"""A call of each tool that needs no programme."""


def exchanged(folder: Path, *messages: object) -> list[dict[str, Any]]:
    """The replies of a server to messages; folder: of the file of the messages."""
    lines = folder / "messages.jsonl"
    texts = (message if isinstance(message, str) else json.dumps(message) for message in messages)
    lines.write_text("".join(f"{text}\n" for text in texts), encoding="utf-8")
    with lines.open(encoding="utf-8") as stream:
        return [json.loads(line) for line in printed(ilmek("mcp", "--folder", EXAMPLES), stdin=stream).splitlines()]


def request(number: int, method: str, **given: object) -> dict[str, object]:
    return {"jsonrpc": "2.0", "id": number, "method": method, "params": given}


def test_a_session(tmp_path: Path) -> None:
    replies = exchanged(
        tmp_path,
        request(1, "initialize", **OPENING),
        {"jsonrpc": "2.0", "method": "notifications/initialized"},
        request(2, "tools/list"),
        request(3, "tools/call", name="design", arguments={"name": "cam", "settings": {"lift": "30mm"}}),
        request(4, "tools/call", name="design", arguments={"name": "cam", "settings": {"lift": "30"}}),
        request(5, "nothing"),
        "rubbish",
    )
    assert [reply["id"] for reply in replies] == [1, 2, 3, 4, 5, None]
    assert replies[0]["result"]["protocolVersion"] == OPENING["protocolVersion"]
    assert [tool["name"] for tool in replies[1]["result"]["tools"]] == list(TOOLS)
    assert json.loads(replies[2]["result"]["content"][0]["text"])["holds"] is True
    (content,) = replies[3]["result"]["content"]
    assert content["text"].startswith("lift=30000 mm is out of bounds")
    assert "did you mean 30mm" in content["text"]
    assert replies[3]["result"]["isError"] is True
    assert [reply["error"]["code"] for reply in replies[4:]] == [-32601, -32700]


def test_at_most_twelve_tools_each_with_a_schema() -> None:
    assert len(TOOLS) <= 12
    assert all(set(tool.schema()["required"]) <= set(tool.arguments) for tool in TOOLS.values())


@pytest.mark.parametrize("name", CALLS)
def test_an_answer_is_json_with_a_verdict(name: str) -> None:
    answer = call_tool(EXAMPLES, name, CALLS[name])
    assert json.loads(json.dumps(answer, default=float))["results"]
    if name in ("design", "study", "run", "cyclogram"):
        assert answer["holds"] == all(check["ok"] for check in answer["checks"])
        assert set(answer["results"]) <= set(answer["units"])


def test_a_mechanism_is_a_file_or_its_text() -> None:
    judged = [call_tool(EXAMPLES, "judge", {"mechanism": given}) for given in ("slider_crank_press.toml", PRESS)]
    assert judged[0] == judged[1]


def test_values_are_in_the_units_that_stand_beside_them() -> None:
    answer = call_tool(EXAMPLES, "design", {"name": "cam"})
    (check, *_) = answer["checks"]
    assert check["unit"] == "rad"
    assert check["value"] == pytest.approx(math.radians(30), rel=1e-3)
    assert (answer["units"]["prime_radius"], answer["results"]["prime_radius"] < 1) == ("m", True)


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("judge", {"mechanism": "../pyproject.toml"}),
        ("judge", {"mechanism": "/etc/passwd"}),
        ("design", {"name": "../press.toml"}),
        ("cyclogram", {"name": "../cyclogram.toml"}),
        ("weave", {"picture": "medallion.png", "out": "../carpet"}),
        ("judge", {}),
        ("judge", {"mechanism": "press.toml", "x": 1}),
        ("nothing", {}),
    ],
)
def test_no_file_outside_the_folder_and_no_wrong_argument(name: str, arguments: dict[str, Any]) -> None:
    with pytest.raises(IlmekError):
        call_tool(EXAMPLES, name, arguments)
