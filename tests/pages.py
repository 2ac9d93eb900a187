"""Pages as the server meets them: a client, and messages awaited."""

import json
from contextlib import contextmanager

from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from motionese.interfaces.page.admission import Admission
from motionese.interfaces.page.application import application
from motionese.interfaces.page.hub import Hub

HERE, LIVE = "http://127.0.0.1:8000", "ws://127.0.0.1:8000/live"


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
            message = self.socket.receive_json()
            self.heard.append(message)
            if message["type"] in kinds and where(message):
                return message

    def closed(self):
        """How the server closes the connection: code and reason."""
        try:
            while True:
                self.socket.receive_json()
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
