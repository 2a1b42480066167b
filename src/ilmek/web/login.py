"""The page that requires the password, where the studio listens beyond the loopback."""

import asyncio
from urllib.parse import parse_qs

from starlette.requests import Request
from starlette.responses import HTMLResponse, RedirectResponse, Response
from starlette.routing import Route

from ilmek.web.safety import Access, entered

FIRST_DELAY = 0.5
"""Delay after the first wrong password [s]; it doubles with each further one."""

LONGEST_DELAY = 16.0
"""Largest delay after a wrong password [s]."""

MOST_WAITING = 8
"""Passwords that wait to be checked; more are refused."""

LONGEST_FORM = 4096
"""Largest body of the form [bytes]."""

pause = asyncio.sleep
"""Lets a time pass [s], while others are served."""

_PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>ilmek studio</title></head><body><main><h1>ilmek studio</h1>
<form method="post" action="/login"><p><label for="password">Password</label>
<input id="password" name="password" type="password" autocomplete="current-password" required autofocus></p>
<p role="alert">{note}</p><p><button>Open the studio</button></p></form></main></body></html>
"""


class Login:
    """Shows the form and checks passwords, one at a time and slower after each wrong one."""

    def __init__(self, access: Access, cookie_name: str) -> None:
        self._access, self._cookie_name = access, cookie_name
        self._wrong = self._waiting = 0
        self._turn = asyncio.Lock()

    async def answer(self, request: Request) -> Response:
        """Answer GET by the form and POST by the studio or the form again."""
        if not self._access.password:
            return RedirectResponse("/", 303)
        if request.method == "GET":
            return HTMLResponse(_PAGE.format(note=""))
        body = b""
        async for part in request.stream():
            body += part
            if len(body) > LONGEST_FORM:
                return HTMLResponse(_PAGE.format(note="The password is not right."), 413)
        if self._waiting >= MOST_WAITING:
            return HTMLResponse(_PAGE.format(note="Too many try to enter; wait a minute."), 429)
        self._waiting += 1
        try:
            async with self._turn:
                right = await self._checked(_password(body))
        finally:
            self._waiting -= 1
        if right:
            return entered(self._access, self._cookie_name)
        return HTMLResponse(_PAGE.format(note="The password is not right."), 403)

    async def _checked(self, password: str) -> bool:
        """Whether a password is right; a wrong one is answered late."""
        if self._access.knows_password(password):
            self._wrong = 0
            return True
        await pause(min(FIRST_DELAY * 2**self._wrong, LONGEST_DELAY))
        self._wrong = min(self._wrong + 1, 20)
        return False


def _password(body: bytes) -> str:
    """The password of a form; the end of a line behind it is that of a file."""
    try:
        found = parse_qs(body.decode("ascii"), max_num_fields=4, encoding="utf-8").get("password", [""])[0]
        return found.rstrip("\r\n")
    except ValueError:
        return ""


def login_routes(access: Access, cookie_name: str) -> list[Route]:
    """The route of the form."""
    return [Route("/login", Login(access, cookie_name).answer, methods=["GET", "POST"])]
