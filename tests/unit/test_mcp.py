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
CALLS: dict[str, dict[str, Any]] = {
    "machines": {},
    "parameters": {"name": "cam"},
    "design": {"name": "cam", "settings": {"lift": "30mm"}},
    "judge": {"path": "quick_return.toml"},
    "run": {"machine": "quick_return.toml", "speed": "60rpm"},
    "crank_rocker": {"swing": "30deg", "ground": "300mm"},
    "path_four_bars": {"points": [[0.1, 0.0], [0.08, 0.02], [0.05, 0.01], [0.07, -0.01]], "count": 1},
    "motion_four_bars": {"points": [[0, 0], [0.025, 0.015], [0.03, 0.001]], "angles": [0.17, 0.05, -0.43]},
    "knot": {
        "points": [
            [0.001 * x, 0.001 * y] for x, y in ((1, 3), (1, -2), (-1, -2), (-1, 2), (3, 2), (3, -2), (1, -2), (1, 3))
        ]
    },
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
        request(3, "tools/call", name="crank_rocker", arguments={"swing": "30deg"}),
        request(4, "tools/call", name="crank_rocker", arguments={"swing": "30"}),
        request(5, "nothing"),
        "rubbish",
    )
    assert [reply["id"] for reply in replies] == [1, 2, 3, 4, 5, None]
    assert replies[0]["result"]["protocolVersion"] == OPENING["protocolVersion"]
    assert [tool["name"] for tool in replies[1]["result"]["tools"]] == list(TOOLS)
    assert json.loads(replies[2]["result"]["content"][0]["text"])["ok"] is True
    (content,) = replies[3]["result"]["content"]
    assert content["text"] == "swing of the crank-rocker: 30 has no unit; write 30deg"
    assert replies[3]["result"]["isError"] is True
    assert [reply["error"]["code"] for reply in replies[4:]] == [-32601, -32700]


def test_at_most_twelve_tools_each_with_a_schema() -> None:
    assert len(TOOLS) <= 12
    assert all(set(tool.schema()["required"]) <= set(tool.arguments) for tool in TOOLS.values())


@pytest.mark.parametrize("name", CALLS)
def test_an_answer_is_json_with_a_verdict(name: str) -> None:
    answer = call_tool(EXAMPLES, name, CALLS[name])
    assert json.loads(json.dumps(answer, default=float))["results"]
    if name in ("design", "run", "cyclogram"):
        assert answer["ok"] == all(check["ok"] for check in answer["checks"])
        assert set(answer["results"]) <= set(answer["units"])


def test_values_are_in_the_units_that_stand_beside_them() -> None:
    answer = call_tool(EXAMPLES, "design", {"name": "cam"})
    (check, *_) = answer["checks"]
    assert check["unit"] == "rad"
    assert check["value"] == pytest.approx(math.radians(30), rel=1e-3)
    assert (answer["units"]["prime_radius"], answer["results"]["prime_radius"] < 1) == ("m", True)


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("judge", {"path": "../pyproject.toml"}),
        ("judge", {"path": "/etc/passwd"}),
        ("design", {"name": "../press.toml"}),
        ("cyclogram", {"name": "../cyclogram.toml"}),
        ("judge", {}),
        ("judge", {"path": "press.toml", "x": 1}),
        ("nothing", {}),
    ],
)
def test_no_file_outside_the_folder_and_no_wrong_argument(name: str, arguments: dict[str, Any]) -> None:
    with pytest.raises(IlmekError):
        call_tool(EXAMPLES, name, arguments)
