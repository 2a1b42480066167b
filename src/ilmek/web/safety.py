"""Who may use the studio: the token of the first address, the cookie after it, and the headers that are checked.

The server listens on the loopback alone unless a host is given. Even there other programs and pages of other sites can
reach it, so that each request needs the cookie (or the token as a bearer), a Host that the server has (against DNS
rebinding) and, where it has an Origin, that of the server (against forged requests and WebSockets of other sites).
"""

import hashlib
import hmac
import secrets
from dataclasses import dataclass, field
from http.cookies import SimpleCookie

from starlette.datastructures import Headers, MutableHeaders, QueryParams
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

CONTENT_POLICY = (
    "default-src 'self'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; font-src 'self'; "
    "connect-src 'self'; worker-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'self'; "
    "frame-ancestors 'none'; frame-src 'self'"
)

HEADERS = {
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(), microphone=(), geolocation=()",
}
"""Headers of every answer beside the content policy."""

LONGEST_BODY = 64 * 2**20
"""Largest body of a request [bytes]."""


@dataclass(frozen=True, slots=True)
class Access:
    """What opens the studio.

    hosts     values of Host that are the server's, with the port
    secret    of the project; the cookie is made from it, so that a page is still known after a restart
    token     of the first address
    password  required where the server listens beyond the loopback; "": none
    """

    hosts: frozenset[str]
    secret: str
    password: str = ""
    token: str = field(default_factory=lambda: secrets.token_urlsafe(24))

    @property
    def cookie(self) -> str:
        """The value of the cookie."""
        return hmac.new(self.secret.encode(), b"studio " + self.password.encode(), hashlib.sha256).hexdigest()

    def knows_token(self, token: str) -> bool:
        """Whether a token is the one of the first address."""
        return hmac.compare_digest(token.encode(), self.token.encode())

    def knows_password(self, password: str) -> bool:
        """Whether a password is right; False where there is none."""
        return bool(self.password) and hmac.compare_digest(password.encode(), self.password.encode())

    def knows_cookie(self, value: str) -> bool:
        """Whether a cookie is right."""
        return hmac.compare_digest(value.encode(), self.cookie.encode())


class Guard:
    """ASGI middleware: refuses what has no right, and adds the headers of safety to every answer."""

    def __init__(self, app: ASGIApp, access: Access, cookie_name: str) -> None:
        self._app, self._access, self._cookie_name = app, access, cookie_name

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request or pass it on."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        if refusal is None:
            await self._app(scope, receive, _with_headers(send))
        elif scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": 1008, "reason": "not allowed"})
        else:
            await refusal(scope, receive, _with_headers(send))

    def _refusal(self, scope: Scope) -> Response | None:
        """The answer to a request that is not allowed; None: it is."""
        headers = Headers(scope=scope)
        host = headers.get("host", "").lower()
        if host not in self._access.hosts:
            return PlainTextResponse("This address is not the studio's.\n", 421)
        origin = headers.get("origin")
        if origin is not None and origin.lower() not in {f"http://{host}", f"https://{host}"}:
            return PlainTextResponse("Requests of other sites are not allowed.\n", 403)
        if headers.get("sec-fetch-site", "same-origin") not in ("same-origin", "none"):
            return PlainTextResponse("Requests of other sites are not allowed.\n", 403)
        if int(headers.get("content-length") or 0) > LONGEST_BODY:
            return PlainTextResponse(f"The request is longer than {LONGEST_BODY:,} bytes.\n", 413)
        if self._is_known(headers):
            return None
        return self._first_visit(scope)

    def _is_known(self, headers: Headers) -> bool:
        kind, _, token = headers.get("authorization", "").partition(" ")
        if kind.lower() == "bearer" and not self._access.password and self._access.knows_token(token.strip()):
            return True
        morsel = SimpleCookie(headers.get("cookie", "")).get(self._cookie_name)
        return morsel is not None and self._access.knows_cookie(morsel.value)

    def _first_visit(self, scope: Scope) -> Response | None:
        query = QueryParams(scope.get("query_string", b""))
        if scope["type"] == "http" and scope["method"] == "GET" and scope["path"] == "/" and "token" in query:
            if self._access.knows_token(query["token"]) and not self._access.password:
                return self.entered()
        if scope["type"] == "http" and scope["path"] == "/login" and self._access.password:
            return None
        text = "Open the studio by the address that `ilmek studio` prints; it has a token.\n"
        return PlainTextResponse(text, 401)

    def entered(self) -> Response:
        """The answer that sets the cookie and leads to the page."""
        response = RedirectResponse("/", 303)
        response.set_cookie(self._cookie_name, self._access.cookie, httponly=True, samesite="strict", path="/")
        return response


def _with_headers(send: Send) -> Send:
    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            for name, value in HEADERS.items():
                headers.setdefault(name, value)
            headers.setdefault("content-security-policy", CONTENT_POLICY)
        await send(message)

    return sent
