"""`tftool view`: the frames in 3-D, in a browser."""

import sys
from typing import TYPE_CHECKING, Annotated

import typer

from tftool.cli.app import ExitStatus
from tftool.cli.connection import Connection
from tftool.cli.options import CacheTime, From, RunFor, within
from tftool.errors import UsageError
from tftool.stamps import Duration

if TYPE_CHECKING:
    from tftool.cli.hosting import Session
    from tftool.screens.browser.server import PageServer


def view(
    connection: Connection,
    place: From = None,
    port: Annotated[
        int,
        typer.Option(
            min=0, max=65535, help="Where to serve the page; the next free one if it is taken."
        ),
    ] = 8765,
    open_browser: Annotated[
        bool, typer.Option("--open", help="Open the page in your browser.")
    ] = False,
    run_for: RunFor = None,
    rate: Annotated[
        float,
        typer.Option(
            "--rate", "-r", metavar="HZ", callback=within(0.1, 120), help="Pictures a second."
        ),
    ] = 30.0,
    cache_time: CacheTime = None,
) -> ExitStatus:
    """Show the frames in 3-D, in a browser (rviz2 with its TF display).

    The page is served on this machine alone, and asks no other for anything. It shows axes,
    names and arrows in any fixed frame, scrubs back through the buffer, and tells the transform
    of a pair you pick.

    tftool view --open
    tftool view robot --port 8800
    """
    try:
        from tftool.screens.browser.server import PageServer
    except ModuleNotFoundError as error:
        if error.name is None or error.name.partition(".")[0] != "websockets":
            raise
        raise UsageError("'view' needs an extra: pip install 'tftool-tf2[view]'") from error
    from tftool.cli.hosting import open_session
    from tftool.cli.notices import notice

    session = open_session(connection, place, cache_time=cache_time)
    page = PageServer(session.world, port=port, rate=rate, tell=notice)
    session.run(_show(session, page, run_for, open_browser))
    return ExitStatus.DONE


async def _show(
    session: "Session", page: "PageServer", duration: Duration | None, open_browser: bool
) -> None:
    import asyncio

    from tftool.cli.notices import notice

    async with page:
        if page.asked_port not in (0, page.port):
            notice(f"Port {page.asked_port} is not free: taking {page.port}.")
        sys.stdout.write(f"The frames of {session.name} are at {page.url}\n")
        sys.stdout.flush()
        if open_browser and not await _opened(page.url):
            notice("No browser could be started: open that address yourself.")
        tasks = {
            asyncio.ensure_future(page.run()),
            asyncio.ensure_future(session.lasting(duration)),
        }
        try:
            ended, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            for task in ended:
                task.result()
        finally:
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)


async def _opened(url: str) -> bool:
    import asyncio
    import webbrowser

    # Some browsers are started and waited for: not in the loop the world lives in.
    return await asyncio.get_running_loop().run_in_executor(None, webbrowser.open, url)
