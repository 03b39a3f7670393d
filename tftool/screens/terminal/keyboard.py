"""How the terminal app reads its keys: what is typed and is no text is dropped."""

from collections.abc import Iterable
from typing import Any

from textual.driver import Driver
from textual.message import Message


def events(sent: str) -> Iterable[Message]:
    """What a terminal sends, as the keys and mouse moves that Textual makes of it.

    The one place that knows where Textual keeps its parser, which it does not promise: where a
    version has moved it, nothing is made.
    """
    try:
        from textual._xterm_parser import XTermParser
    except ImportError:
        return ()
    return XTermParser().feed(sent)


def tolerant(driver: type[Driver]) -> type[Driver]:
    """A driver that reads on after bytes that are no UTF-8, where it reads bytes itself.

    Textual's own takes them for a failure of the app: a terminal of another encoding, or a
    cat on the keyboard, would end it with a traceback.

    Args:
        driver: What Textual takes on this platform; that of Windows has no bytes to decode.
    """
    if not hasattr(driver, "run_input_thread"):
        return driver
    base: Any = driver

    class TolerantDriver(base):  # type: ignore[misc]
        def run_input_thread(self) -> None:
            while True:
                try:
                    super().run_input_thread()
                except UnicodeDecodeError as error:
                    # What was read together with them is kept; the next round reads what follows.
                    for event in events(error.object.decode(errors="ignore")):
                        self.process_message(event)
                    continue
                return

    return TolerantDriver
