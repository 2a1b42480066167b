"""Who may use the studio: the token of the first address, the cookie after it, and the headers that are checked.

The server listens on the loopback alone unless a host is given. Even there other programs and pages of other sites can
reach it, so that each request needs the cookie (or the token as a bearer), a Host that the server has (against DNS
rebinding) and, where it has an Origin, that of the server (against forged requests and WebSockets of other sites).
"""

import hashlib
import hmac
import ipaddress
import secrets
import time
from dataclasses import dataclass, field

from starlette.datastructures import Headers, MutableHeaders, QueryParams
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ilmek.web.framing import JSON, error_body

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

LONGEST_BODY = 64_000_000
"""Largest body of a request [bytes]."""

CLOSE = {"connection": "close"}
"""Header of an answer after which the rest of the request is not read."""

COOKIE_AGE = 30 * 86400
"""Life of the cookie [s]."""


@dataclass(frozen=True, slots=True)
class Access:
    """What opens the studio.

    hosts            values of Host that are the server's, with the port
    secret           of the project; the cookie is made from it, so that a page is still known after a restart
    password         required where the server listens beyond the loopback, and then no token helps; "": none
    token            of the first address
    browser_token    the same for one visit: the browser is started with it, and other accounts can see that
    everywhere_port  not 0: a Host of digits with this port is the server's too; only a name can be rebound
    """

    hosts: frozenset[str]
    secret: str
    password: str = ""
    token: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    browser_token: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    everywhere_port: int = 0

    @property
    def cookie(self) -> str:
        """The value of the cookie."""
        return hmac.new(self.secret.encode(), b"studio " + self.password.encode(), hashlib.sha256).hexdigest()

    def knows_host(self, host: str) -> bool:
        """Whether a value of Host is the server's."""
        if host in self.hosts:
            return True
        name, _, port = host.rpartition(":")
        try:
            ipaddress.ip_address(name.strip("[]"))
        except ValueError:
            return False
        return self.everywhere_port != 0 and port == str(self.everywhere_port)

    def knows_token(self, token: str) -> bool:
        """Whether a token is the one of the first address; False where a password is required."""
        return hmac.compare_digest(token.encode(), self.token.encode()) and not self.password

    def knows_browser_token(self, token: str) -> bool:
        """Whether a token is the one that the browser is started with; False where a password is required."""
        return hmac.compare_digest(token.encode(), self.browser_token.encode()) and not self.password

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
        self._browser_visited = False

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request or pass it on."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        send = _with_headers(send, time.perf_counter())
        if refusal is None:
            await self._app(scope, receive, send)
        elif scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": 1008, "reason": "not allowed"})
        else:
            await refusal(scope, receive, send)

    def _refusal(self, scope: Scope) -> Response | None:
        """The answer to a request that is not allowed, or to the first one; None: it is passed on."""
        headers = Headers(scope=scope)
        host = headers.get("host", "").lower()
        if not self._access.knows_host(host):
            return _refused(scope, 421, "this address is not the studio's", "open the one that `ilmek studio` prints")
        if not _is_of_this_site(headers, host):
            return _refused(scope, 403, "a request of another site", "open the studio by its own address")
        length = headers.get("content-length") or "0"
        if not length.isdecimal() or int(length[:20]) > LONGEST_BODY:
            return _refused(scope, 413, f"a body of more than {LONGEST_BODY:,} bytes", "take a smaller file")
        return self._with_token(scope) if self._is_known(headers) else self._first_visit(scope)

    def _with_token(self, scope: Scope) -> Response | None:
        """Where a page that is known comes with a token: the address without it, which stays in the history."""
        opened = scope["type"] == "http" and scope["path"] == "/" and scope["query_string"].startswith(b"token=")
        return RedirectResponse("/", 303) if opened else None

    def _is_known(self, headers: Headers) -> bool:
        kind, _, token = headers.get("authorization", "").partition(" ")
        if kind.lower() == "bearer" and self._access.knows_token(token.strip()):
            return True
        return any(self._access.knows_cookie(value) for value in cookies(headers, self._cookie_name))

    def _opens(self, token: str) -> bool:
        """Whether a token opens the studio; that of the browser does so once."""
        if not self._browser_visited and self._access.knows_browser_token(token):
            self._browser_visited = True
            return True
        return self._access.knows_token(token)

    def _first_visit(self, scope: Scope) -> Response | None:
        if scope["type"] == "http":
            token = QueryParams(scope.get("query_string", b"")).get("token", "")
            if scope["method"] == "GET" and scope["path"] == "/" and self._opens(token):
                return entered(self._access, self._cookie_name)
            if self._access.password and scope["path"] == "/login":
                return None
            if self._access.password and scope["method"] == "GET" and scope["path"] == "/":
                return RedirectResponse("/login", 303)
        return _refused(scope, 401, "no token of the studio", "open the address that `ilmek studio` prints; it has one")


def _refused(scope: Scope, status: int, given: str, do: str) -> Response:
    """A refusal, to a program as the API has it. The rest of the request is not read."""
    if scope["path"].startswith("/api/"):
        return Response(error_body(given, do=do), status, CLOSE, media_type=JSON)
    return PlainTextResponse(f"{given}; {do}\n", status, CLOSE)


def _is_of_this_site(headers: Headers, host: str) -> bool:
    """Whether a request comes from a page of the studio, from an address that was typed, or from no page at all."""
    own = (f"http://{host}", f"https://{host}")
    if any(origin.lower() not in own for origin in headers.getlist("origin")):
        return False
    return all(site in ("same-origin", "none") for site in headers.getlist("sec-fetch-site"))


def cookies(headers: Headers, name: str) -> list[str]:
    """The values of a cookie; other cookies of the host may be of any form."""
    pairs = (pair.strip().partition("=") for line in headers.getlist("cookie") for pair in line.split(";"))
    return [value for key, _, value in pairs if key == name]


def entered(access: Access, cookie_name: str) -> Response:
    """The answer that sets the cookie and leads to the page."""
    response = RedirectResponse("/", 303)
    response.set_cookie(cookie_name, access.cookie, httponly=True, samesite="strict", path="/", max_age=COOKIE_AGE)
    return response


def _with_headers(send: Send, began: float) -> Send:
    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            for name, value in HEADERS.items():
                headers.setdefault(name, value)
            headers.setdefault("content-security-policy", CONTENT_POLICY)
            headers.append("server-timing", f"total;dur={1000 * (time.perf_counter() - began):.1f}")
        await send(message)

    return sent
