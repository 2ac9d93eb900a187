"""The worker process: started, fed, listened to, and started again when it was killed."""

import asyncio
import contextlib
import multiprocessing
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import TypeVar

from motionese.interfaces.page.messages import Answer, Tell, worker_message
from motionese.interfaces.page.worker import Origin, work
from motionese.one_core import one_core_each

T = TypeVar("T")
AT_MOST = 5
"""A process that dies more often before it was ready is not started again."""


class Supervisor:
    """Holds the worker process; all methods are called in the server's event loop."""

    def __init__(self, origin: Origin, told: Tell) -> None:
        """Prepare a worker; `told` gets its messages, and its deaths as 'worker' messages."""
        self._origin, self._told = origin, told
        self._process: multiprocessing.process.BaseProcess | None = None
        self._connection: Connection | None = None
        self._stopping = False
        self._failures = 0

    @property
    def pid(self) -> int | None:
        """The worker's process number."""
        return self._process.pid if self._process else None

    def start(self) -> None:
        """Start the worker and listen to it from a thread."""
        context = multiprocessing.get_context("spawn")
        ours, theirs = context.Pipe()
        with one_core_each():
            process = context.Process(
                target=work, args=(theirs, self._origin), name="motionese robot", daemon=True
            )
            process.start()
        theirs.close()
        self._process, self._connection = process, ours
        loop = asyncio.get_running_loop()
        threading.Thread(target=self._listen, args=(ours, loop), daemon=True).start()

    def say(self, message: Answer) -> None:
        """Send the worker a message; one to a worker that is just dying is lost."""
        if self._connection is not None:
            with contextlib.suppress(OSError):
                self._connection.send(message)

    def stop(self) -> None:
        """End the worker; what it has learned is saved."""
        self._stopping = True
        self.say({"type": "end"})
        if self._process is not None:
            self._process.join(1.0)
            if self._process.is_alive():
                self._process.kill()

    def _listen(self, connection: Connection, loop: asyncio.AbstractEventLoop) -> None:
        while True:
            try:
                message = connection.recv()
            except (EOFError, OSError):
                break
            _in(loop, self._heard, message)
        _in(loop, self._died, connection)

    def _heard(self, message: Answer) -> None:
        if message["type"] == "refused":
            self._stopping = True
        if message.get("type") == "worker" and message["state"] == "ready":
            self._failures = 0
        self._told(message)

    def _died(self, connection: Connection) -> None:
        if self._stopping or connection is not self._connection:
            return
        connection.close()
        self._failures += 1
        if self._failures > AT_MOST:
            self._connection = None
            sentence = "The robot's process ends again and again; see the terminal."
            self._told(worker_message("failed", sentence))
            return
        sentence = "The robot's process had ended; it is starting again from the saved session."
        self._told(worker_message("restarted", sentence))
        self.start()


def _in(loop: asyncio.AbstractEventLoop, call: Callable[[T], None], argument: T) -> None:
    with contextlib.suppress(RuntimeError):  # the loop has ended
        loop.call_soon_threadsafe(call, argument)
