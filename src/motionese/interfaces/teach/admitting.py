"""Every request passes here: it is let in or not, and its answer gets the safety headers."""

from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse, RedirectResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from motionese.interfaces.teach.safety import COOKIE, HEADERS, Admission


class Admitting:
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
        reason = self._admission.refusal(headers, given or _kept(headers), socket=socket)

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


def _kept(headers: dict[str, str]) -> str:
    try:
        cookies = SimpleCookie(headers.get("cookie", ""))
    except CookieError:
        return ""
    return cookies[COOKIE].value if COOKIE in cookies else ""
