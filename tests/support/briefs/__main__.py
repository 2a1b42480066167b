"""`make campaigns PARTS=briefs`: an agent's calls for briefs of a designer's day, by the protocol itself.

    python -m briefs                 all briefs; ends with 1 where fewer than 95 % end in what passes its checks
    python -m briefs cam loom        those whose kind has one of the words
    python -m briefs --seed 7            in another order: no answer depends on the calls before
    python -m briefs --server PYTHON     the server by another interpreter than the client's

The server is another process; the client is that of the library `mcp` (`pip install mcp`). A brief is done where no
call is refused and its last answer holds.
"""

import argparse
import asyncio
import json
import os
import random
import shutil
import sys
import tempfile
import time
from collections.abc import Iterable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from briefs.brief import Brief
from briefs.carpets import CARPETS, LOOMS, TUFTED
from briefs.linkages import MECHANISMS, STUDIES, SYNTHESES, TIMES
from briefs.machines import BEATING, CAMS, KNOTS, WARPS

ROOT = Path(__file__).parents[3]
BRIEFS = (*CAMS, *BEATING, *WARPS, *KNOTS, *SYNTHESES, *MECHANISMS, *STUDIES, *TIMES, *CARPETS, *TUFTED, *LOOMS)
LEAST_SHARE = 0.95


async def fault(client: Any, brief: Brief) -> str:
    """Why a brief does not end in something that passes its checks; "" where it does."""
    answer: dict[str, Any] = {}
    for tool, arguments in brief.calls:
        result = await client.call_tool(tool, arguments)
        text = result.content[0].text
        if not text.startswith("{"):
            return text
        answer = json.loads(text)
    if answer.get("holds"):
        return ""
    failed = [check["name"] for check in answer.get("checks", ()) if not check["ok"]]
    return f"does not hold: {', '.join(failed) or answer}"


async def tried(briefs: Iterable[Brief], python: str) -> list[Brief]:
    """The briefs that are not done; a line for each."""
    left, mcp = [], import_module("mcp")
    stdio_client = import_module("mcp.client.stdio").stdio_client
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(ROOT / "examples", folder, dirs_exist_ok=True)
        environment = {**os.environ, "PYTHONPATH": str(ROOT / "src")}
        words = ["-m", "ilmek", "mcp", "--folder", folder]
        server = mcp.StdioServerParameters(command=python, args=words, env=environment)
        async with stdio_client(server) as streams, mcp.ClientSession(*streams) as client:
            await client.initialize()
            for brief in briefs:
                begin = time.monotonic()
                why = await fault(client, brief)
                if why:
                    left.append(brief)
                show(f"{time.monotonic() - begin:5.1f} s  {brief.kind}: {why or 'done'}")
    return left


def show(text: str) -> None:
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def main() -> int:
    """Try the briefs of the command line."""
    parser = argparse.ArgumentParser(prog="python -m briefs", description=__doc__)
    parser.add_argument("words", nargs="*", help="of the kinds; default: all")
    parser.add_argument("--seed", type=int, default=0, help="of the order")
    parser.add_argument("--server", default=sys.executable, help="interpreter of the server")
    given = parser.parse_args()
    if find_spec("mcp") is None:
        parser.error("the client is missing: pip install mcp")
    chosen = [brief for brief in BRIEFS if not given.words or any(word in brief.kind for word in given.words)]
    random.Random(given.seed).shuffle(chosen)
    left = asyncio.run(tried(chosen, given.server))
    done = len(chosen) - len(left)
    show(
        f"{done} of {len(chosen)} briefs of {len({brief.kind for brief in chosen})} kinds end in what passes its checks"
    )
    return int(done < LEAST_SHARE * len(chosen))


if __name__ == "__main__":
    sys.exit(main())
