"""`ilmek mcp`: tools for agents over standard input and output, by the Model Context Protocol (JSON-RPC 2.0)."""

import json
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import click

from ilmek import __version__
from ilmek.api.tools import TOOLS, call_tool
from ilmek.errors import IlmekError
from ilmek.io.json_file import json_text
from ilmek.records import JsonObject

PROTOCOL = "2025-06-18"
"""Version of the protocol [modelcontextprotocol.io, specification 2025-06-18]."""

EXAMPLES = """\b
Examples:
  ilmek mcp --folder designs

Each message is a line of JSON. The answer of a tool has its verdict, its checks and its results with units.
"""


@click.command(epilog=EXAMPLES)
@click.option(
    "--folder",
    type=click.Path(path_type=Path, exists=True, file_okay=False),
    default=".",
    show_default=True,
    help="The folder of the files that tools may read.",
)
def command(folder: Path) -> int:
    """Serve twelve tools to an agent: machines, mechanisms, synthesis, knots, cyclograms, programmes."""
    for line in sys.stdin:
        if line.strip():
            reply = answered(folder, line)
            if reply is not None:
                click.echo(json.dumps(reply))
    return 0


def answered(folder: Path, line: str) -> JsonObject | None:
    """The reply to a message; None for a notification."""
    try:
        message = json.loads(line)
        number, method, given = message.get("id"), message["method"], message.get("params") or {}
    except (ValueError, KeyError, AttributeError, TypeError):
        return _reply(None, error={"code": -32700, "message": "a line is no message of JSON-RPC 2.0"})
    if number is None:
        return None
    if method not in METHODS:
        return _reply(number, error={"code": -32601, "message": f"there is no method {method!r}"})
    return _reply(number, METHODS[method](folder, given))


def _initialized(_folder: Path, _given: JsonObject) -> JsonObject:
    facts = {"name": "ilmek", "version": __version__}
    return {"protocolVersion": PROTOCOL, "capabilities": {"tools": {}}, "serverInfo": facts}


def _listed(_folder: Path, _given: JsonObject) -> JsonObject:
    tools = [{"name": name, "description": tool.doc, "inputSchema": tool.schema()} for name, tool in TOOLS.items()]
    return {"tools": tools}


def _called(folder: Path, given: JsonObject) -> JsonObject:
    try:
        text, failed = json_text(call_tool(folder, str(given.get("name")), given.get("arguments") or {})), False
    except IlmekError as error:
        text, failed = str(error), True
    return {"content": [{"type": "text", "text": text}], "isError": failed}


def _reply(number: object, result: object = None, error: object = None) -> JsonObject:
    return {"jsonrpc": "2.0", "id": number, **({"result": result} if error is None else {"error": error})}


METHODS: Mapping[str, Callable[[Path, JsonObject], JsonObject]] = {
    "initialize": _initialized,
    "ping": lambda _folder, _given: {},
    "tools/list": _listed,
    "tools/call": _called,
}
"""Methods of the protocol that are answered."""
