"""Who may speak with the server: hosts, origins, the token; and what a page may load.

Every request passes here, and every answer gets the safety headers.

A page of another site that a person has open can send requests to 127.0.0.1, and by rebinding its
name to that address even read the answers. Its Host and Origin give it away.
"""

import hmac
import ipaddress
from collections.abc import Mapping
from dataclasses import dataclass
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs, urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse, RedirectResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from motionese.errors import SettingError

HEADERS = {
    "content-security-policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
        "img-src 'self' data: blob:; media-src 'self' blob:; font-src 'self'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(self), microphone=(), geolocation=()",
    "cache-control": "no-store",
}
LOCAL = ("127.0.0.1", "localhost", "::1")
COOKIE = "motionese-token"
SHORTEST_TOKEN = 8


@dataclass(frozen=True)
class Admission:
    """Who is let in.

    Attributes:
        host: The address that the server listens at.
        token: What a page must know; empty where only this machine can reach the server.
    """

    host: str
    token: str = ""

    def __post_init__(self) -> None:
        if not is_local(self.host) and not self.token:
            raise SettingError(
                f"--host {self.host} can be reached from other machines: give a --token of at "
                f"least {SHORTEST_TOKEN} characters that a page must know"
            )
        if self.token and (len(self.token) < SHORTEST_TOKEN or not self.token.isascii()):
            raise SettingError(
                f"--token: at least {SHORTEST_TOKEN} characters, all of them ASCII, are needed"
            )

    def refusal(self, headers: Mapping[str, str], token: str, *, acts: bool) -> str:
        """Return why a request is refused, or "".

        Args:
            headers: The request's headers, names in lower case.
            token: The token it brought, or "".
            acts: Whether it opens a WebSocket, or sends something: those must tell their origin.
        """
        host, origin = headers.get("host", ""), headers.get("origin")
        if not self._known_host(host):
            return "this name is not one of the server's"
        if origin is None and acts:
            return "a connection must tell its origin"
        if origin is not None and origin not in (f"http://{host}", f"https://{host}"):
            return "pages of other sites are not let in"
        if self.token and not hmac.compare_digest(token.encode(), self.token.encode()):
            return "the token is missing or wrong: open the address that the command printed"
        return ""

    def _known_host(self, host: str) -> bool:
        """Whether a Host header names this server, and not a name that was rebound to it.

        An address cannot be rebound; so where other machines may come, any address is right.
        """
        try:
            name = urlsplit(f"//{host}").hostname or ""
        except ValueError:
            return False
        others_come = not is_local(self.host)
        return name in (*LOCAL, self.host) or (others_come and _address(name) is not None)


def is_local(host: str) -> bool:
    """Whether an address can be reached from this machine alone."""
    address = _address(host)
    return host == "localhost" if address is None else address.is_loopback


def _address(host: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    try:
        return ipaddress.ip_address(host)
    except ValueError:
        return None


class Gate:
    """ASGI middleware around the server.

    A token comes once in the address, and then as a cookie that no script and no other site sees.
    """

    def __init__(self, app: ASGIApp, admission: Admission) -> None:
        """Stand before `app`."""
        self._app, self._admission = app, admission

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let a request in, or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        headers = {name.lower(): value for name, value in Headers(scope=scope).items()}
        given = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[0]
        socket = scope["type"] == "websocket"
        acts = socket or scope["method"] not in ("GET", "HEAD")
        reason = self._admission.refusal(headers, given or _cookie(headers), acts=acts)

        async def guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(HEADERS)
            await send(message)

        if reason and socket:
            await receive()
            await send({"type": "websocket.close", "code": 1008, "reason": reason})
        elif reason:
            await PlainTextResponse(f"{reason}\n", status_code=403)(scope, receive, guarded)
        elif given and self._admission.token and not socket:
            answer = RedirectResponse(scope["path"], status_code=303)
            answer.set_cookie(COOKIE, given, httponly=True, samesite="strict")
            await answer(scope, receive, guarded)
        else:
            await self._app(scope, receive, guarded)


def _cookie(headers: dict[str, str]) -> str:
    try:
        cookies = SimpleCookie(headers.get("cookie", ""))
    except CookieError:
        return ""
    return cookies[COOKIE].value if COOKIE in cookies else ""
