"""A session goes out as one file, and comes in as one, which is looked at before it is opened.

What comes in is unpacked beside the session and gets a number; the page that owns the session may
then ask for it to be opened (see `messages.Open`). Nothing is replaced before.
"""

from pathlib import Path
from tempfile import TemporaryDirectory
from uuid import uuid4

from starlette.concurrency import run_in_threadpool
from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, PlainTextResponse, Response
from starlette.routing import Route

from motionese.errors import StorageError
from motionese.teaching.packed_session import MOST_PACKED, SUFFIX, pack, unpack
from motionese.teaching.session_contents import OPENED, clear_opened

PATH = f"/session{SUFFIX}"
DOWNLOAD = {"content-disposition": f'attachment; filename="robot-school{SUFFIX}"'}
SENT = "This file"
NOT_FOUND, TOO_LARGE, UNREADABLE = 404, 413, 422


def sharing(session: Path) -> Route:
    """Return where a session's file is had from (GET) and sent to (POST)."""

    async def shared(request: Request) -> Response:
        if request.method == "POST":
            return await _taken(request, session)
        try:
            packed = await run_in_threadpool(pack, session)
        except StorageError as error:
            return PlainTextResponse(str(error), status_code=NOT_FOUND)
        return Response(packed, media_type="application/octet-stream", headers=DOWNLOAD)

    return Route(PATH, shared, methods=["GET", "POST"])


async def _taken(request: Request, session: Path) -> Response:
    """Take a file in, and answer by what name it can be opened."""
    with TemporaryDirectory() as folder:
        file, size = Path(folder) / f"sent{SUFFIX}", 0
        try:
            with file.open("wb") as content:
                async for part in request.stream():
                    size += len(part)
                    if size > MOST_PACKED:
                        sentence = f"{SENT} is larger than a session can be."
                        return PlainTextResponse(sentence, status_code=TOO_LARGE)
                    content.write(part)
            name = await run_in_threadpool(_unpacked, file, session)
        except ClientDisconnect:
            return PlainTextResponse("", status_code=UNREADABLE)  # nobody hears it
        except StorageError as error:
            return PlainTextResponse(str(error), status_code=UNREADABLE)
        except OSError as error:
            sentence = f"{SENT} cannot be kept: {error.strerror}"
            return PlainTextResponse(sentence, status_code=UNREADABLE)
    return JSONResponse({"file": name})


def _unpacked(file: Path, session: Path) -> str:
    """Unpack a file beside a session, in the place of any that came before."""
    clear_opened(session)
    name = uuid4().hex
    unpack(file, session / f"{OPENED}{name}", SENT)
    return name
