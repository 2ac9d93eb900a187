"""`motionese teach`: serve the page until Ctrl-C."""

import socket
import webbrowser
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import quote

from filelock import FileLock, Timeout
from rich.console import Console

from motionese.errors import SettingError, StorageError, needs
from motionese.interfaces.page.messages import MOST_BYTES, Answer, Tell
from motionese.interfaces.page.supervisor import Supervisor
from motionese.interfaces.page.worker import Origin

LOCK = ".lock"
MOST_CONNECTIONS = 64


def teach(
    console: Console, *, begin: str, session: Path, host: str, port: int, token: str, browser: bool
) -> None:
    """Serve the page on which a person teaches the robot, until Ctrl-C.

    Raises:
        MissingPackageError: Starlette or uvicorn are not installed.
        SettingError: A host without a token, or an address that cannot be listened at.
    """
    try:
        import uvicorn  # noqa: PLC0415

        from motionese.interfaces.page.admission import Admission, is_local  # noqa: PLC0415
        from motionese.interfaces.page.application import application  # noqa: PLC0415
        from motionese.interfaces.page.hub import Hub  # noqa: PLC0415
    except ImportError as error:
        raise needs(error.name or "starlette", "web", "motionese teach") from error
    admission = Admission(host, token)
    with _alone(session), _listening(host, port) as listener:
        port = listener.getsockname()[1]
        name = f"[{host}]" if ":" in host else host
        address = f"http://{name}:{port}/" + (f"?token={quote(token)}" if token else "")

        def begun() -> None:
            console.print(f"Teach the robot at {address} (Ctrl-C ends; the session is kept)")
            if not is_local(host):
                console.print("Other machines can reach it; what is said is not encrypted")

        reasons: list[str] = []

        def refused(sentence: str) -> None:
            reasons.append(sentence)
            server.should_exit = True

        origin = Origin(begin, session)
        unopened = [address] if browser else []

        def supervised(told: Tell) -> Supervisor:
            def heard(message: Answer) -> None:
                told(message)
                # Not before it is known that there is a robot to be taught.
                if message["type"] == "scene" and unopened:
                    webbrowser.open(unopened.pop())

            return Supervisor(origin, heard)

        hub = Hub(supervised, refused)
        app = application(hub, admission, session, begun)
        config = uvicorn.Config(
            app,
            log_level="warning",
            access_log=False,
            limit_concurrency=MOST_CONNECTIONS,
            ws_max_size=MOST_BYTES,
            server_header=False,
            timeout_graceful_shutdown=1,
        )
        server = uvicorn.Server(config)
        server.run(sockets=[listener])
    if reasons:
        raise SettingError(reasons[0])


@contextmanager
def _alone(session: Path) -> Iterator[None]:
    """Keep other servers out of a session's folder; the lock is the operating system's."""
    lock = FileLock(session / LOCK, blocking=False)
    try:
        session.mkdir(parents=True, exist_ok=True)
        held = lock.acquire()
    except Timeout as error:
        raise StorageError(f"{session}: another process teaches in this session") from error
    except OSError as error:
        raise StorageError(f"{session} cannot be written to: {error.strerror}") from error
    with held:
        yield


@contextmanager
def _listening(host: str, port: int) -> Iterator[socket.socket]:
    """Listen at an address; port 0 is any that is free."""
    try:
        found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
        family, kind, number, _, address = found[0]
        listener = socket.socket(family, kind, number)
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(address)
        listener.listen()  # whoever comes before the server is up waits for it
    except OSError as error:
        raise SettingError(f"--host {host} --port {port}: {error.strerror}") from error
    with listener:
        yield listener
