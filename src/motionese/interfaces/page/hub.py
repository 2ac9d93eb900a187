"""The one session of a server: its worker, the page that owns it, and pages that wait."""

import asyncio
import time
from collections.abc import Callable
from contextlib import suppress

from starlette.websockets import WebSocket, WebSocketDisconnect

from motionese.interfaces.page.messages import (
    Answer,
    Hello,
    Message,
    Pace,
    Pen,
    RefusedError,
    Strokes,
    Tell,
    understood,
    worker_message,
)
from motionese.interfaces.page.supervisor import Supervisor

POLICY, MOST_WAITING = 1008, 4096
KEPT = ("scene", "session", "robots", "map", "emergence")
"""What a page is told when it comes: the last of each."""
OUTDATING = ("learned", "grown", "begun", "emergence")
"""What a map is not true after."""
IN_USE = "Another page is teaching this robot. You can take over: its page is told so."


class Hub:
    """Passes messages between one page and the worker."""

    def __init__(
        self, supervised: Callable[[Tell], Supervisor], refused: Callable[[str], None]
    ) -> None:
        """Take what makes a supervisor that tells a function; `refused` is told why none begins."""
        self._refused = refused
        self._supervisor = supervised(self._told)
        self._owner: Visit | None = None
        self._last: dict[str, Answer] = {}
        self.worker = worker_message("starting", "Waking the robot.")

    def open(self) -> None:
        """Start the worker."""
        self._supervisor.start()

    def close(self) -> None:
        """End the worker."""
        self._supervisor.stop()

    @property
    def worker_pid(self) -> int | None:
        """The worker's process number."""
        return self._supervisor.pid

    async def visited(self, socket: WebSocket) -> None:
        """Serve one page until it leaves, or says what it must not."""
        await socket.accept()
        visit = Visit(socket)
        sending = asyncio.create_task(visit.send_all())
        try:
            await self._listen(visit)
        except RefusedError as error:
            sending.cancel()
            await visit.leave(str(error))
        finally:
            sending.cancel()
            if self._owner is visit:
                self._owner = None
                self._supervisor.say({"type": "left"})

    async def _listen(self, visit: "Visit") -> None:
        while True:
            event = await visit.socket.receive()
            if event["type"] == "websocket.disconnect":
                return
            visit.pace.one_more()
            if event.get("text") is None:
                raise RefusedError("messages must be text")
            message = understood(event["text"])
            if isinstance(message, Hello):
                self._greet(visit, message)
            elif self._owner is visit:
                self._pass_on(visit, message)
            elif not visit.known:
                raise RefusedError("a page must say hello first")
            else:
                visit.tell({"type": "told", "kind": "refusal", "sentence": IN_USE})

    def _greet(self, visit: "Visit", hello: Hello) -> None:
        visit.known = True
        if self._owner not in (None, visit) and not hello.take:
            visit.tell({"type": "owner", "yours": False, "sentence": IN_USE})
            return
        if self._owner not in (None, visit):
            sentence = "Another page has taken over; you can take the robot back."
            self._owner.tell({"type": "owner", "yours": False, "sentence": sentence})
            self._supervisor.say({"type": "left"})
        self._owner = visit
        visit.strokes = Strokes()
        visit.tell({"type": "owner", "yours": True, "sentence": ""})
        visit.tell(self.worker)
        for kind in KEPT:
            if kind in self._last:
                visit.tell(self._last[kind])

    def _pass_on(self, visit: "Visit", message: Message) -> None:
        if isinstance(message, Pen):
            visit.strokes.check(message)
        if self.worker["state"] in ("ready", "starting"):
            said = message.model_dump(by_alias=True)
            self._supervisor.say({**said, "received": time.monotonic()})
        elif not isinstance(message, Pen) or message.phase == "down":
            visit.tell({"type": "told", "kind": "hint", "sentence": self.worker["sentence"]})

    def _told(self, message: Answer) -> None:
        """Take a message of the worker's."""
        kind = message["type"]
        if kind == "refused":
            message = worker_message("failed", message["sentence"])
            kind = "worker"
            self._refused(message["sentence"])
        if kind == "worker":
            self.worker = message
        if kind in OUTDATING:
            self._last.pop("map", None)
        if kind == "begun":
            self._last.pop("emergence", None)
        if kind in KEPT:
            self._last[kind] = message
        if self._owner is not None:
            self._owner.tell(message)


class Visit:
    """One page's connection."""

    def __init__(self, socket: WebSocket) -> None:
        """Serve a socket that was accepted."""
        self.socket = socket
        self.known = False
        self.pace, self.strokes = Pace(), Strokes()
        self._waiting: asyncio.Queue[Answer] = asyncio.Queue(MOST_WAITING)

    def tell(self, message: Answer) -> None:
        """Send a message when the page takes it; one that takes none loses the newest."""
        if not self._waiting.full():
            self._waiting.put_nowait(message)

    async def send_all(self) -> None:
        """Send what waits, for ever."""
        with suppress(WebSocketDisconnect, RuntimeError):  # the page has left
            while True:
                await self.socket.send_json(await self._waiting.get())

    async def leave(self, reason: str) -> None:
        """Close the connection with a reason of at most 123 bytes, as the protocol has it."""
        short = reason.encode()[:120].decode(errors="ignore")
        with suppress(WebSocketDisconnect, RuntimeError):
            await self.socket.close(POLICY, short)
