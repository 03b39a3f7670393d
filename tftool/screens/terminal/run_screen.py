"""A screen and the life of its world, side by side until one of them ends."""

import asyncio
import os
from collections.abc import Coroutine
from typing import Any

from tftool.base.errors import TftoolError
from tftool.screens.terminal.world_app import WorldApp
from tftool.world.stopping import leave_screen


async def show(app: WorldApp, life: Coroutine[Any, Any, None], *, headless: bool = False) -> None:
    """Put the app on the terminal while its world lives, until one of them ends.

    Whatever ends it, the terminal is restored before this returns or raises.

    Args:
        app: What to show.
        life: Lives the app's world through; cancelled when the user quits.
        headless: Do all of it but draw on a terminal.

    Raises:
        NodeFailed: If a node raised.
        TftoolError: If the screen itself failed.
        KeyboardInterrupt: If the user pressed Ctrl-C.
    """
    # Ctrl-C as a signal, not as a key: the loop, which reads keys, may be held up by a node.
    os.environ.setdefault("TEXTUAL_ALLOW_SIGNALS", "1")
    undo = app.world.clock.when_killed.add(leave_screen, "screen")
    screen = asyncio.ensure_future(app.run_async(headless=headless))

    async def lived() -> None:
        # Making the panels takes a while in which no node would get its turn.
        await app.ready.wait()
        app.begin(app.world.clock.now())
        await life

    living = asyncio.ensure_future(lived())
    try:
        await asyncio.wait({living, screen}, return_when=asyncio.FIRST_COMPLETED)
    finally:
        if not screen.done():
            app.exit()
            await asyncio.wait({screen})
        living.cancel()
        await asyncio.wait({living})
        life.close()
        undo()
    if not living.cancelled():
        living.result()
    if app.failure is not None:
        raise TftoolError(
            f"the screen failed: {type(app.failure).__name__}: {app.failure}"
        ) from app.failure
    screen.result()
    if app.interrupted:
        raise KeyboardInterrupt
