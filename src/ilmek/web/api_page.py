"""The readable page of the API at /api, and the table of the manual, from the table of the API.

python -m ilmek.web.api_page FILE       writes the table into docs/reference/studio-api.md
"""

import re
import sys
from html import escape
from pathlib import Path

from starlette.requests import Request
from starlette.responses import HTMLResponse

from ilmek.web.endpoints import ENDPOINTS, Endpoint

_PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>ilmek studio: API</title></head><body><main><h1>The API of the studio</h1>
<p>Requests and answers are JSON, in SI units and radians. Types: <a href="/api/openapi.json">openapi.json</a> (OpenAPI
3.1). Outside the browser: header <code>Authorization: Bearer TOKEN</code>, the token of the studio's first address.</p>
<p>An error has status 4xx or 5xx and <code>{{"error": {{"given": "", "allowed": "", "do": ""}}}}</code>. Header
<code>x-language: tr</code>: checks and refusals of charts in Turkish. A work
answers 202 and <code>{{"work": N}}</code>; <code>GET /api/work/N</code> gives its state (202) or its answer (200),
<code>DELETE /api/work/N</code> cancels it, and the WebSocket <code>/api/events</code> reports its progress.</p>
<table><thead><tr><th scope="col">request</th><th scope="col">what it does</th></tr></thead><tbody>
{rows}
</tbody></table></main></body></html>
"""


async def api_page(request: Request) -> HTMLResponse:
    """The page."""
    return HTMLResponse(_PAGE.format(rows="\n".join(map(_row, request.app.state.endpoints))))


def _row(endpoint: Endpoint) -> str:
    return f"<tr><td><code>{escape(_request(endpoint))}</code></td><td>{escape(_note(endpoint))}</td></tr>"


def _request(endpoint: Endpoint) -> str:
    return f"{endpoint.method} /api{endpoint.path.replace(':path', '')}"


def _note(endpoint: Endpoint) -> str:
    work = " A work." if endpoint.work else ""
    body = f" Body: {', '.join(endpoint.upload)}." if endpoint.upload else ""
    return f"{endpoint.summary}{work}{body}"


def with_table(page: str) -> str:
    r"""A page of the manual with the table of the API between its lines `| request | what it does |` and an empty one.

    >>> print(with_table("a\n| request | what it does |\nold\n\nb").splitlines()[-3])
    | `POST /api/carpet/picture` | A picture of the project as it is read, made small (packed). |
    """
    rows = "\n".join(f"| `{_request(endpoint)}` | {_note(endpoint)} |" for endpoint in ENDPOINTS)
    head = "| request | what it does |\n"
    return re.sub(re.escape(head) + r"(.+\n)*\n", lambda _: f"{head}|---|---|\n{rows}\n\n", page, count=1)


if __name__ == "__main__":
    file = Path(sys.argv[1])
    file.write_text(with_table(file.read_text(encoding="utf-8")), encoding="utf-8")
