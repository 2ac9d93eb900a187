"""Pages as the server meets them: a client, and messages awaited."""

import json
from contextlib import contextmanager

import anyio
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from motionese.interfaces.page.admission import Admission
from motionese.interfaces.page.application import application
from motionese.interfaces.page.hub import Hub

HERE, LIVE = "http://127.0.0.1:8000", "ws://127.0.0.1:8000/live"
PATIENCE_S = 90.0
"""A message that has not come by then will not come: a test fails, and does not wait for ever."""


class Page:
    """One page's connection."""

    def __init__(self, socket):
        self.socket = socket
        self.heard = []

    def say(self, message):
        self.socket.send_text(message if isinstance(message, str) else json.dumps(message))

    def hear(self, *kinds, where=lambda message: True):
        """The next message of these kinds; those before it are kept in `heard`."""
        while True:
            message = self._next(f"{' or '.join(kinds)} after {self.heard[-3:]}")
            self.heard.append(message)
            if message["type"] in kinds and where(message):
                return message

    def _next(self, awaited):
        async def received():
            with anyio.fail_after(PATIENCE_S):
                return await self.socket._send_rx.receive()

        try:
            message = self.socket.portal.call(received)
        except TimeoutError:
            raise AssertionError(f"waited {PATIENCE_S:g} s in vain for {awaited}") from None
        self.socket._raise_on_close(message)
        return json.loads(message["text"])

    def closed(self):
        """How the server closes the connection: code and reason."""
        try:
            while True:
                self._next("the end of the connection")
        except WebSocketDisconnect as left:
            return left.code, left.reason


class Nobody:
    """In the supervisor's place: hears everything, answers nothing."""

    def __init__(self, told):
        self.told, self.heard, self.pid = told, [], None

    def start(self):
        self.told({"type": "worker", "state": "ready", "sentence": ""})

    def say(self, message):
        self.heard.append(message)

    def stop(self):
        pass


@contextmanager
def served(supervised, session, admission=None):
    """A server with the supervisor that `supervised` makes."""
    refused = []
    hub = Hub(supervised, refused.append)
    app = application(hub, admission or Admission("127.0.0.1"), session)
    with TestClient(app, base_url=HERE) as client:
        client.hub, client.refused = hub, refused
        yield client


@contextmanager
def page(client, hello=True, **more):
    """A page that has said hello."""
    with client.websocket_connect(LIVE, headers={"origin": HERE}) as socket:
        opened = Page(socket)
        if hello:
            opened.say({"type": "hello", **more})
        yield opened
