"""Files that the server sends as they are: the built client, and the files of the project in a sandbox."""

import hashlib
import mimetypes
from pathlib import Path
from urllib.parse import quote

from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, Response

CLIENT = Path(__file__).with_name("client")
"""The built client; its sources are in studio/."""

SANDBOX = (
    "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data: blob: 'self'; font-src data:; connect-src 'none'; form-action 'none'; frame-ancestors 'self'"
)
"""Policy of files of the project: a page there runs its own script, but is a stranger to the studio."""

_KINDS = {".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".woff2": "font/woff2"}


def within(folder: Path, path: str) -> Path | None:
    """The file at a path below a folder; None: there is none, it is hidden, or it lies elsewhere (by .. or a link)."""
    parts = path.split("/")
    if any(part.startswith(".") or "\\" in part or "\0" in part for part in parts):
        return None
    try:
        root = folder.resolve(strict=True)
        found = root.joinpath(*parts).resolve(strict=True)
        return found if found.is_relative_to(root) and found.is_file() else None
    except (OSError, RuntimeError):  # not there, without permission, or a loop of links
        return None


async def client_file(request: Request) -> Response:
    """A file of the client; index.html at /. What has its digest in its name is kept for ever."""
    path = request.path_params.get("path") or "index.html"
    found = within(CLIENT, path)
    if found is None:
        text = "Not found.\n" if path != "index.html" else "The client is not built: npm run build in studio/.\n"
        return PlainTextResponse(text, 404)
    content = found.read_bytes()
    tag = f'"{hashlib.sha256(content).hexdigest()[:32]}"'
    lasting = path.startswith("assets/")
    headers = {"etag": tag, "cache-control": "public, max-age=31536000, immutable" if lasting else "no-cache"}
    if tag in request.headers.get("if-none-match", ""):
        return Response(status_code=304, headers=headers)
    return Response(content, media_type=_kind(found), headers=headers)


async def project_file(request: Request) -> Response:
    """A file of the project; with ?download=1 to be saved."""
    found = within(Path(request.app.state.project), request.path_params["path"])
    if found is None:
        return PlainTextResponse("Not found.\n", 404)
    headers = {"content-security-policy": SANDBOX, "cache-control": "no-cache"}
    if request.query_params.get("download"):
        headers["content-disposition"] = f"attachment; filename*=utf-8''{quote(found.name)}"
    return FileResponse(found, media_type=_kind(found), headers=headers)


def _kind(path: Path) -> str:
    return _KINDS.get(path.suffix) or mimetypes.guess_type(path.name)[0] or "application/octet-stream"
