"""Server of the local page: addresses, safety, and the life of its temporary folder."""

from __future__ import annotations

import asyncio
import contextlib
import os
import shutil
import signal
import socket
import tempfile
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any, TypeVar
from urllib.parse import urlsplit

import uvicorn
from markupsafe import escape
from starlette.applications import Starlette
from starlette.background import BackgroundTask
from starlette.datastructures import UploadFile
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.middleware.trustedhost import TrustedHostMiddleware
from starlette.requests import Request
from starlette.responses import FileResponse, HTMLResponse, RedirectResponse, Response
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from seisblock.app import forms, views
from seisblock.app.jobs import JobState, start_fork_server
from seisblock.app.sessions import Tab, Tabs
from seisblock.app.uploads import MAX_FILES, BodyLimit, UploadTooLargeError, save_uploads
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.core._signals import temporary_handler
from seisblock.core.errors import ParameterError, SeisblockError
from seisblock.core.i18n import LANGUAGES, N_, get_locale, gettext, use_locale
from seisblock.output.io.workbook import convert_csv
from seisblock.readers.discover import group_files
from seisblock.readers.options import ReadOptions
from seisblock.records.analytic import is_analytic
from seisblock.samples import DEFAULT_SAMPLE, REAL_SAMPLE, sample_names

HOST = "127.0.0.1"
"""Address of the server: this computer only."""

ALLOWED_HOSTS = (HOST, "localhost")
"""Host names under which a browser on this computer reaches the page; others are refused (DNS rebinding)."""

DEFAULT_PORT = 8765

SHUTDOWN_S = 2
"""Time that open connections have at the end, s."""

PAGE_POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "img-src 'self' data:",
        "connect-src 'self'",
        "frame-src 'self'",
        "form-action 'self'",
        "base-uri 'none'",
        "frame-ancestors 'self'",
    )
)
"""Content security policy of the page: nothing from outside, no inline script."""

RESULT_POLICY = (
    "sandbox allow-scripts allow-popups allow-downloads allow-modals; default-src 'none'; script-src 'unsafe-inline'; "
    "style-src 'unsafe-inline'; img-src data: blob:; media-src data: blob:; font-src data:"
)
"""Policy of pages that commands write: their scripts run in an origin of their own, without access to this page or a network."""

EVENT_FOLDER = "event"
"""Folder of the files of stations among the uploads."""

Value = TypeVar("Value")

Handler = Callable[[Request, Tab], Any]


class RefuseForeignOrigin:
    """ASGI middleware that refuses requests that a page of another origin sends."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on requests of this page and add the headers of its policy."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers = {key: value.decode("latin-1") for key, value in scope["headers"]}
        origin = headers.get(b"origin")
        is_foreign = origin is not None and urlsplit(origin).netloc != headers.get(b"host")
        if is_foreign or headers.get(b"sec-fetch-site", "none") == "cross-site":
            await Response("request of another origin refused", 403)(scope, receive, send)
            return

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                present = {key.lower() for key, _ in message["headers"]}
                guard = {
                    b"content-security-policy": PAGE_POLICY.encode(),
                    b"x-content-type-options": b"nosniff",
                    b"referrer-policy": b"no-referrer",
                    b"cache-control": b"no-store",
                }
                message["headers"] = [*message["headers"], *((key, value) for key, value in guard.items() if key not in present)]
            await send(message)

        await self._app(scope, receive, send_guarded)


def create_app(folder: Path, locale: str | None = None) -> Starlette:
    """Return the ASGI application.

    Parameters
    ----------
    folder : Path
        Folder of the uploads and results.
    locale : "en", "ja" or None
        Language of the page unless its address tells another; default: that of the environment.
    """
    tabs = Tabs(folder, max(2, os.cpu_count() or 1))
    page_locale = get_locale(locale)

    @contextlib.asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        del app
        yield
        await tabs.close()

    def in_tab(handler: Handler) -> Callable[[Request], Any]:
        """Return an endpoint: the tab of the address, its language, and errors as sentences."""

        async def endpoint(request: Request) -> Response:
            tab = tabs.get(request.path_params["token"])
            if tab is None:
                raise HTTPException(404)
            with use_locale(tab.locale):
                try:
                    response: Response = await handler(request, tab)
                except SeisblockError as error:
                    # files are named as the user named them, without the temporary folder
                    response = _error_response(gettext(error.message).replace(f"{tab.files}{os.sep}", ""))
                except UploadTooLargeError:
                    response = _error_response(gettext(TOO_LARGE), 413, tab)
                except HTTPException as error:
                    if error.status_code != 400:
                        raise
                    response = _error_response(gettext(UNREADABLE_FORM, count=MAX_FILES), 400, tab)  # of the parser of forms
                return response

        return endpoint

    async def index(request: Request) -> Response:
        language = request.query_params.get("lang", page_locale)
        tab = tabs.open(language if language in LANGUAGES else page_locale)
        with use_locale(tab.locale):
            return HTMLResponse(views.page(tab), background=BackgroundTask(start_fork_server))

    async def missing(request: Request, error: Exception) -> Response:
        """Answer an address that does not exist, or a tab that the server no longer has."""
        del error
        if request.headers.get("hx-request"):
            with use_locale(page_locale):
                return _error_response(gettext(EXPIRED))
        return RedirectResponse("/", 303) if request.url.path.startswith("/t/") else Response("not found", 404)

    async def failed(request: Request, error: Exception) -> Response:
        """Answer a defect of the page without details; the terminal has them."""
        del request, error
        with use_locale(page_locale):
            return _error_response(gettext(DEFECT), 500)

    routes = [
        Route("/", index),
        Mount("/static", StaticFiles(directory=Path(__file__).with_name("static"))),
        Route("/t/{token}/", in_tab(show_page)),
        Route("/t/{token}/alive", in_tab(alive)),
        Route("/t/{token}/address", in_tab(address)),
        Route("/t/{token}/record", in_tab(choose_record), methods=["POST"]),
        Route("/t/{token}/fields", in_tab(object_fields)),
        Route("/t/{token}/floor", in_tab(floor_value)),
        Route("/t/{token}/object", in_tab(run_object), methods=["POST"]),
        Route("/t/{token}/film", in_tab(run_film), methods=["POST"]),
        Route("/t/{token}/report", in_tab(report)),
        Route("/t/{token}/survey", in_tab(run_survey), methods=["POST"]),
        Route("/t/{token}/collection", in_tab(run_collection), methods=["POST"]),
        Route("/t/{token}/secure/{number:int}", in_tab(run_secure), methods=["POST"]),
        Route("/t/{token}/event", in_tab(run_event), methods=["POST"]),
        Route("/t/{token}/jobs/{kind}/{serial:int}", in_tab(show_job)),
        Route("/t/{token}/cancel/{kind}", in_tab(cancel), methods=["POST"]),
        Route("/t/{token}/files/{kind}/{name}", in_tab(result_file)),
    ]
    middleware = [
        Middleware(TrustedHostMiddleware, allowed_hosts=list(ALLOWED_HOSTS)),
        Middleware(RefuseForeignOrigin),
        Middleware(BodyLimit),
    ]
    return Starlette(routes=routes, middleware=middleware, lifespan=lifespan, exception_handlers={404: missing, 500: failed})


TOO_LARGE = N_("file too large: at most 200 MB can be uploaded; give larger archives to the command line")
EXPIRED = N_("this page is no longer known to the server: reload it")
DEFECT = N_("defect of the program: the terminal of seisblock app shows the details; please report them")
NO_MOTION = N_("{text!r} is not an analytic motion; write, for example, sine:300gal@1.5Hz,10s or pulse:300gal@1.5Hz")
NO_FILE = N_("no file was uploaded: choose one")
NO_RECORD = N_("no record in the first tab: choose one there, or the other computation here")
UNREADABLE_FORM = N_("upload damaged, or of more than {count} files: give an archive of them")


def _error_response(text: str, status: int = 200, tab: Tab | None = None) -> Response:
    """Return the region of errors; htmx puts it where it belongs, whatever was asked for."""
    return HTMLResponse(views.error(text, tab), status, headers={"HX-Retarget": "#error", "HX-Reswap": "outerHTML"})


async def alive(request: Request, tab: Tab) -> Response:
    """Keep the tab."""
    del request, tab
    return Response(status_code=204)


async def address(request: Request, tab: Tab) -> Response:
    """Answer the request by which the page takes the address of its tab."""
    del request, tab
    return Response()


async def show_page(request: Request, tab: Tab) -> Response:
    """Return the page of a tab once more: after a reload, on the way back, or in the other language."""
    language = request.query_params.get("lang", tab.locale)
    if language in LANGUAGES and language != tab.locale:
        await tab.set_locale(language)
    with use_locale(tab.locale):
        return HTMLResponse(views.page(tab))


async def _uploads(request: Request, tab: Tab, kind: str, *, folder: str = "") -> tuple[list[str], dict[str, str]]:
    """Save the files of a form in the tab's folder; return their names and the other fields.

    Files of another kind are kept: a sheet with the file name of the record gets a number.
    """
    async with tab.uploading, request.form(max_files=MAX_FILES) as form:
        fields = {key: forms.plain_text(value) for key, value in form.multi_items() if isinstance(value, str)}
        uploads = [value for _, value in form.multi_items() if isinstance(value, UploadFile)]
        taken = () if folder else {EVENT_FOLDER, forms.SCENARIO_TABLE, *tab.names_of_others(kind)}
        names = await save_uploads(uploads, tab.files / folder, taken=taken)
    return names, fields


async def choose_record(request: Request, tab: Tab) -> Response:
    """Take uploaded files, a bundled sample, an analytic motion or an intensity as the ground motion, and describe it."""
    names, fields = await _uploads(request, tab, "record")
    source = fields.get("source", "upload")
    chosen = names if source == "upload" else [fields.get(source, "")]
    if source != "options" and not any(chosen):
        raise ParameterError(NO_FILE)
    if source == "motion" and not is_analytic(chosen[0]):
        raise ParameterError(NO_MOTION, text=chosen[0][:80])
    if source == "sample" and chosen[0] not in sample_names("record"):
        raise HTTPException(404)
    if source == "options" and not tab.uploaded:
        return Response(status_code=204)  # they serve the next files
    if source == "options":
        chosen = list(tab.uploaded)
    elif source == "upload":
        chosen = [*await asyncio.to_thread(_rest_of_set, tab, names), *names]
    for name in set(tab.uploaded) - set(chosen):
        (tab.files / name).unlink(missing_ok=True)
    is_upload = source in ("upload", "options")
    tab.uploaded = tuple(chosen) if is_upload else ()
    await tab.cancel("record")
    await tab.cancel("object")  # its result is that of the previous record
    if source == "intensity":
        tab.record, tab.intensity = (), chosen[0]
        return HTMLResponse(views.intensity_summary(tab))
    tab.record, tab.intensity = (*chosen, *(forms.record_options(fields) if is_upload else ())), ""
    tab.record_form = fields if is_upload else {}
    await tab.start("record", ("measure", *tab.record), {"--plot": "figure.png"})
    return HTMLResponse(views.job_started(tab, "record"))


def _rest_of_set(tab: Tab, names: list[str]) -> list[str]:
    """Return the previous files of a record to which the new ones are further components, as those of a station of K-NET are."""
    previous = [name for name in tab.uploaded if name not in names]
    records = list(group_files([str(tab.files / name) for name in (*previous, *names)], ReadOptions())) if previous else []
    return previous if len(records) == 1 else []


async def object_fields(request: Request, tab: Tab) -> Response:
    """Return the fields of the object that was chosen."""
    return HTMLResponse(views.object_fields(tab, request.query_params))


async def floor_value(request: Request, tab: Tab) -> Response:
    """Return the number at which a slider of the height stands."""
    del tab
    return HTMLResponse(escape(request.query_params.get("floor", "")[:8]))


async def run_object(request: Request, tab: Tab) -> Response:
    """Compute the response of the object."""
    names, fields = await _uploads(request, tab, "object")
    if names:
        tab.body_files = tuple(names)
    body = forms.body_arguments(fields, tab.body_files)
    first = forms.scan_arguments(fields, tab.body_files)
    floor, options = forms.floor_arguments(fields), forms.solver_arguments(fields)
    if tab.intensity:
        line = ("scenario", "--jma", tab.intensity, *floor, *forms.scenario_object([*body, *options], tab.files))
        outputs = {"--plot": "figure.png", "--csv": "objects.csv", "--html": "report.html"}
    else:
        line = ("respond", *tab.record, *body, *floor, *options)
        outputs = {"--plot": "figure.png", "--csv": "histories.csv"}
    tab.form = fields
    for kind in ("film", "report"):
        await tab.cancel(kind)
    await tab.start("object", line, outputs, first)
    return HTMLResponse(views.job_started(tab, "object"))


async def run_film(request: Request, tab: Tab) -> Response:
    """Draw the film of the object's motion."""
    del request
    job = tab.jobs.get("object")
    if job is None or job.arguments[0] != "respond":
        raise HTTPException(404)
    await tab.start("film", (*job.arguments, "--runs", "0"), {"--animate": "film.html"})
    return HTMLResponse(views.job_started(tab, "film"))


async def _new_sheet(request: Request, tab: Tab, kind: str) -> dict[str, str]:
    """Take the sheet of a survey or a collection, or keep the previous one; return the other fields of the form."""
    names, fields = await _uploads(request, tab, kind)
    if names:
        tab.sheets[kind] = names[0]
    if kind not in tab.sheets:
        raise ParameterError(NO_FILE)
    return fields


async def run_survey(request: Request, tab: Tab) -> Response:
    """Compute a sheet of gravestones: the shaking that its falls tell, or the falls under the record."""
    fields = await _new_sheet(request, tab, "survey")
    sheet = tab.sheets["survey"]
    cemetery = await asyncio.to_thread(_in_locale, tab.locale, read_cemetery, tab.files / sheet)
    tab.columns = views.cemetery_facts(cemetery)
    outputs = {"--plot": "figure.png", "--csv": "table.csv", "--stones": "stones.csv"}
    if fields.get("under") == "record" and not tab.record:
        raise ParameterError(NO_RECORD)
    if fields.get("under") == "record" or all(stone.fallen is None for stone in cemetery.stones):
        line = ("overturn-rate", *(tab.record or (DEFAULT_SAMPLE,)), "--cemetery", sheet)
    else:
        line = ("infer", "--cemetery", sheet)
    await tab.start("survey", line, outputs)
    return HTMLResponse(views.job_started(tab, "survey"))


async def run_collection(request: Request, tab: Tab) -> Response:
    """Compute a list of objects in a scenario."""
    fields = await _new_sheet(request, tab, "collection")
    tab.scenario = forms.scenario_arguments(fields, tab.record)
    outputs = {"--plot": "figure.png", "--csv": "table.csv", "--html": "page.html"}
    await tab.cancel("secure")
    await tab.start("collection", ("scenario", *tab.scenario, "--bodies", tab.sheets["collection"]), outputs)
    return HTMLResponse(views.job_started(tab, "collection"))


async def run_secure(request: Request, tab: Tab) -> Response:
    """Search the measures that make one object of the collection safe."""
    job = tab.jobs.get("collection")
    if job is None or job.state is not JobState.DONE:
        raise HTTPException(404)
    names = [row["body"] for row in job.document["results"]]
    number = request.path_params["number"]
    if number >= len(names):
        raise HTTPException(404)
    line = ("secure", *tab.scenario, "--bodies", tab.sheets["collection"], "--object", names[number])
    await tab.start("secure", line, {"--plot": "figure.png"})
    return HTMLResponse(views.job_started(tab, "secure"))


async def run_event(request: Request, tab: Tab) -> Response:
    """Map the stations of a folder or archive with an object or a cemetery at each."""
    await tab.cancel("event")
    if request.headers.get("content-type", "").startswith("multipart"):
        await asyncio.to_thread(shutil.rmtree, tab.files / EVENT_FOLDER, ignore_errors=True)
    names, fields = await _uploads(request, tab, "event", folder=EVENT_FOLDER)
    if names:
        tab.sheets["event"] = EVENT_FOLDER
    elif fields.get("sample"):
        tab.sheets["event"] = REAL_SAMPLE
    if "event" not in tab.sheets:
        raise ParameterError(NO_FILE)
    line = ("map", tab.sheets["event"], *forms.event_arguments(fields, tab.sheets.get("survey")))
    await tab.start("event", line, {"--html": "map.html", "--csv": "table.csv"})
    return HTMLResponse(views.job_started(tab, "event"))


async def report(request: Request, tab: Tab) -> Response:
    """Return the HTML report of record and object; it is written at the first request."""
    del request
    job = tab.jobs.get("object")
    if job is None or job.state is not JobState.DONE:
        raise HTTPException(404)
    if job.arguments[0] == "scenario":
        return _page_response(job.folder / "report.html")
    async with tab.reporting:
        if "report" not in tab.jobs:
            await tab.start("report", forms.report_arguments(job.arguments), {"--output": "report.html"})
        writer = tab.jobs["report"]
        await writer.wait()
    if writer.state is not JobState.DONE:
        return HTMLResponse(views.error_page(writer.error), 500)
    return _page_response(writer.folder / "report.html")


def _page_response(path: Path) -> Response:
    return FileResponse(path, headers={"Content-Security-Policy": RESULT_POLICY})


async def show_job(request: Request, tab: Tab) -> Response:
    """Return progress or result of a job; after a job that was cancelled or replaced the page asks no more."""
    kind = request.path_params["kind"]
    job = tab.jobs.get(kind)
    if job is None or request.path_params["serial"] != tab.serials[kind]:
        return Response(status_code=204)
    if job.state in (JobState.WAITING, JobState.RUNNING):
        return HTMLResponse(views.progress(tab, kind, job))
    text = await asyncio.to_thread(_in_locale, tab.locale, views.ended, tab, kind, job)
    return HTMLResponse(text, headers={"HX-Retarget": f"#{kind}-slot", "HX-Reswap": "innerHTML"})


def _in_locale(locale: str, function: Callable[..., Value], *args: Any) -> Value:
    with use_locale(locale):
        return function(*args)


async def cancel(request: Request, tab: Tab) -> Response:
    """Cancel a job."""
    kind = request.path_params["kind"]
    if kind not in views.KINDS:
        raise HTTPException(404)
    await tab.cancel(kind)
    return HTMLResponse(views.cancelled(tab, kind))


async def result_file(request: Request, tab: Tab) -> Response:
    """Return an output file of a job."""
    job, name = tab.jobs.get(request.path_params["kind"]), request.path_params["name"]
    if job is None or job.state is not JobState.DONE or name.replace(".xlsx", ".csv") not in (*job.outputs.values(), "result.json"):
        raise HTTPException(404)
    command = job.arguments[0]
    if name.endswith(".xlsx"):
        await asyncio.to_thread(convert_csv, job.folder / name.replace(".xlsx", ".csv"), job.folder / name)
        return FileResponse(job.folder / name, filename=f"{command}-{name}")
    if name == "result.json":
        return FileResponse(job.folder / "stdout.txt", media_type="application/json", filename=f"{command}.json")
    if name.endswith(".html"):
        return _page_response(job.folder / name)
    if name.endswith(".csv"):
        return FileResponse(job.folder / name, media_type="text/csv; charset=utf-8", filename=f"{command}-{name}")
    return FileResponse(job.folder / name)


def bind(port: int | None) -> socket.socket:
    """Return a listening socket of this computer only; without `port`, :data:`DEFAULT_PORT` or a free one.

    Raises
    ------
    ParameterError
        If the port is in use.
    """
    for number in (DEFAULT_PORT, 0) if port is None else (port,):
        listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        if os.name == "posix":
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((HOST, number))
        except OSError:
            listener.close()
            continue
        return listener
    raise ParameterError("port {port} is in use: give another one, or omit --port", port=port)


def serve(listener: socket.socket, on_ready: Callable[[], None], locale: str | None = None) -> None:
    """Serve the page until Ctrl-C or the end of the terminal; uploads and results are gone at the end.

    Parameters
    ----------
    listener : socket
        From :func:`bind`.
    on_ready : callable
        Called once the page can be opened.
    locale : "en", "ja" or None
    """
    with listener, tempfile.TemporaryDirectory(prefix="seisblock-app-", ignore_cleanup_errors=True) as folder:
        app = create_app(Path(folder), locale)
        config = uvicorn.Config(
            app, log_level="warning", access_log=False, server_header=False, timeout_graceful_shutdown=SHUTDOWN_S, lifespan="on"
        )
        server = _Server(config, on_ready)
        # a terminal that is closed ends the server as Ctrl-C does; Windows has no such signal
        hang_up = getattr(signal, "SIGHUP", None)
        with contextlib.nullcontext() if hang_up is None else temporary_handler(hang_up, server.handle_exit, default=signal.SIG_DFL):
            server.run(sockets=[listener])


class _Server(uvicorn.Server):
    def __init__(self, config: uvicorn.Config, on_ready: Callable[[], None]) -> None:
        super().__init__(config)
        self._on_ready = on_ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            self._on_ready()
