"""``seisblock app``: the local page."""

from __future__ import annotations

from contextlib import suppress
from importlib.util import find_spec

import click

from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.core.errors import SeisblockError
from seisblock.core.i18n import get_locale

REQUIRED = ("starlette", "uvicorn", "python_multipart")
"""Modules of the extra ``app``."""


@click.command(cls=Command, examples=("seisblock app", "seisblock app --port 8000 --no-browser --lang ja"))
@option("--port", type=click.IntRange(1, 65535), metavar="N", help="Port of the page. [default: 8765, or a free one]")
@option("--no-browser", is_flag=True, help="Print the address only; open no browser.")
def app(port: int | None, no_browser: bool) -> None:
    """Local page in the browser: one object, a survey, a collection, an event.

    Requires the extra app. The page is served on this computer only, loads nothing from outside and sends nothing. Ctrl-C ends it; its
    temporary files are removed.
    """
    missing = [name for name in REQUIRED if find_spec(name) is None]
    if missing:
        raise SeisblockError("the local page requires {names}: pip install 'seisblock[app]'", names=missing)
    from seisblock.app.server import HOST, bind, serve

    listener = bind(port)
    address = f"http://{HOST}:{listener.getsockname()[1]}/"

    def announce() -> None:
        info("page: {address} (Ctrl-C ends it)", address=address)
        if not no_browser:
            import webbrowser

            webbrowser.open(address)

    with suppress(KeyboardInterrupt):  # the usual end
        serve(listener, announce, get_locale())
