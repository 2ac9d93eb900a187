"""The web server: the page and its files, the connection, the export, the session as a file."""

import contextlib
from collections.abc import AsyncIterator, Callable
from pathlib import Path

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles

from motionese.interfaces.page.admission import Admission, Gate
from motionese.interfaces.page.hub import Hub
from motionese.interfaces.page.sharing import sharing
from motionese.teaching.packed_session import read_taught

PAGE = Path(__file__).parent / "web"
EXPORT = "demonstrations.npz"
"""The file of demonstrations, `caregiver.DEMONSTRATIONS`; its room takes a second to import."""


def application(
    hub: Hub, admission: Admission, session: Path, begun: Callable[[], None] = lambda: None
) -> Starlette:
    """Return the server of one teaching session, kept in a folder by the robot's process.

    `begun` is called when the server is about to answer.
    """

    @contextlib.asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        hub.open()
        begun()
        try:
            yield
        finally:
            hub.close()

    async def page(request: Request) -> Response:
        return FileResponse(PAGE / "index.html")

    async def health(request: Request) -> Response:
        return JSONResponse({"worker": hub.worker["state"]})

    async def export(request: Request) -> Response:
        file = session / read_taught(session) / EXPORT
        if not file.is_file():
            return PlainTextResponse("Nothing was shown yet.", status_code=404)
        return FileResponse(file, media_type="application/octet-stream", filename=file.name)

    app = Starlette(
        routes=[
            Route("/", page),
            Route("/health", health),
            Route("/export.npz", export),
            sharing(session),
            WebSocketRoute("/live", hub.visited),
            Mount("/static", StaticFiles(directory=PAGE)),
        ],
        lifespan=lifespan,
    )
    app.add_middleware(Gate, admission=admission)
    return app
