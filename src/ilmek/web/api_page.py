"""The readable page of the API at /api, from its table."""

from html import escape

from starlette.requests import Request
from starlette.responses import HTMLResponse

from ilmek.web.endpoints import Endpoint

_PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>ilmek studio: API</title></head><body><main><h1>The API of the studio</h1>
<p>Requests and answers are JSON, in SI units and radians. Types: <a href="/api/openapi.json">openapi.json</a> (OpenAPI
3.1). Outside the browser: header <code>Authorization: Bearer TOKEN</code>, the token of the studio's first address.</p>
<p>An error has status 4xx or 5xx and <code>{{"error": {{"given": "", "allowed": "", "do": ""}}}}</code>. A work
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
    kinds = f" Body: {', '.join(endpoint.upload)}." if endpoint.upload else ""
    note = escape(f"{endpoint.summary}{' A work.' if endpoint.work else ''}{kinds}")
    return f"<tr><td><code>{endpoint.method} /api{escape(endpoint.path)}</code></td><td>{note}</td></tr>"
