"""Implementation of `tftool session`: processes, nodes, topics and rates of the running session."""

import asyncio
import json
import sys
from typing import Any

from rich.console import Console
from rich.text import Text

from tftool.base.errors import LinkError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible
from tftool.base.stamps import Duration, as_seconds
from tftool.commands.session import SessionOptions
from tftool.commands.shared.connection import Connection, Mode
from tftool.commands.shared.notices import notice
from tftool.drawing import session_view as view
from tftool.world.clock import run as run_loop
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION
from tftool.world.link.graph import NODE, SERVER
from tftool.world.link.seam import Arrived
from tftool.world.link.session import Link, is_plain


def _rates(connection: Connection, link: Link, lasting: Duration) -> dict[str, float]:
    """Count messages during `lasting`; return the rate in hertz of each topic that had messages."""
    counts: dict[str, int] = {}
    clock = connection.providers.wall_clock()

    def count(name: str) -> Any:
        def heard(_: Arrived) -> None:
            counts[name] = counts.get(name, 0) + 1

        return heard

    async def listen() -> None:
        link.middleware.start(asyncio.get_running_loop())
        for name, ros_type in {(one.name, one.ros_type) for one in link.graph.entities(PUBLISHER)}:
            # Topics with irregular names, of other programs, are listed without a rate.
            if is_plain(name) and is_plain(ros_type):
                link.middleware.listen(name, ros_type, count(name))
        link.settle()
        await clock.sleep(lasting)

    if not link.graph.is_empty:
        run_loop(clock, listen())
    return {name: count / as_seconds(lasting) for name, count in counts.items()}


def _as_object(link: Link, rates: dict[str, float]) -> dict[str, Any]:
    """Return all facts about a session as a mapping, for --json; `rates` are in hertz."""
    graph = link.graph
    topics: dict[str, dict[str, Any]] = {}
    for one in graph.entities(PUBLISHER, SUBSCRIPTION):
        rate = rates.get(one.name, 0.0)
        topic = topics.setdefault(
            one.name, {"type": one.ros_type, "publishers": [], "subscribers": [], "rate": rate}
        )
        topic["publishers" if one.kind == PUBLISHER else "subscribers"].append(one.node)
    for topic in topics.values():
        topic["publishers"].sort()
        topic["subscribers"].sort()
    return {
        "domain": link.options.domain,
        "processes": [
            {
                "command": one.command,
                "pid": one.pid,
                "role": one.role.value,
                "since": as_seconds(one.since),
                "nodes": sorted(
                    {each.node for each in graph.entities(NODE) if each.session == one.session}
                ),
            }
            for one in graph.processes()
        ],
        "nodes": sorted({one.node for one in graph.entities(NODE)}),
        "topics": {name: topics[name] for name in sorted(topics)},
        "services": {
            one.name: {"type": one.ros_type, "node": one.node}
            for one in sorted(graph.entities(SERVER), key=lambda one: one.name)
        },
    }


def _written(facts: dict[str, Any], *, verbose: bool) -> str:
    """Format the facts about a session as text that fits the terminal."""
    if not sys.stdout.isatty():
        return "\n".join(line.plain for line in view.lines(facts, verbose=verbose))

    console = Console()
    lines = view.lines(
        facts,
        verbose=verbose,
        width=console.width,
        height=console.height,
        ascii_only=console.options.ascii_only,
    )
    with console.capture() as captured:
        console.print(Text("\n").join(lines), soft_wrap=True, end="")
    return captured.get()


def run(connection: Connection, options: SessionOptions) -> ExitStatus:
    """Run `tftool session`: print the processes, nodes, topics and services of the session."""
    if options.place is not None:
        raise UsageError(
            f"'{visible(options.place)}' is not the address of a session: give the address of a "
            "Foxglove server, such as ws://robot:8765, or no address for the session of this "
            "machine."
        )
    if connection.mode is Mode.HOST:
        raise UsageError(
            "'session' only lists the processes of a running session: leave out --host."
        )
    link = connection.open_link()
    if link is None:
        raise LinkError(
            "'session' needs a connection to other processes, but was started without one"
        )
    if link.unanswering:
        notice(link.unanswering)
    elif link.graph.is_empty:
        notice(
            f"No session is running in domain {connection.domain}: start one, for example with "
            "'tftool demo'."
        )
    found = _as_object(link, _rates(connection, link, options.listen_for))
    text = json.dumps(found) if options.for_programs else _written(found, verbose=options.verbose)
    sys.stdout.write(text + "\n")
    return ExitStatus.DONE
