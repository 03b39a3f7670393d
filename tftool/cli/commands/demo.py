"""`tftool demo`: a scenario on the screen, or, without a terminal, played and summed up."""

from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tftool.cli.app import ExitStatus
from tftool.cli.connection import Connection
from tftool.cli.options import (
    Ascii,
    Json,
    Light,
    duration,
    positive,
    refuse_long_simulation,
    within,
)
from tftool.errors import UsageError
from tftool.stamps import Duration

if TYPE_CHECKING:
    from tftool.nodes.teleop import Teleop


def demo(
    connection: Connection,
    scenario: Annotated[
        str | None,
        typer.Argument(
            metavar="[FROM]",
            help="Scenario to play, a built-in name or a file; or a recording to look at. "
            "If not said: what runs here already, else turtles.",
            show_default=False,
        ),
    ] = None,
    source_frame: Annotated[
        str | None,
        typer.Option(metavar="FRAME", help="Whom turtle2 follows: turtle1, carrot1, ..."),
    ] = None,
    rate: Annotated[
        float,
        typer.Option(
            metavar="TIMES", callback=within(0.001, 1000), help="How many times real time."
        ),
    ] = 1.0,
    lasting: Annotated[
        Duration | None,
        typer.Option(
            "--for",
            metavar="SECONDS",
            parser=duration(positive),
            help="End after so many seconds of the world's time.",
        ),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help="Set any argument of the scenario."),
    ] = None,
    recording: Annotated[
        Path | None,
        typer.Option(
            "--record", metavar="FILE", help="Record the world of the demo to an .mcap file."
        ),
    ] = None,
    ascii_only: Ascii = False,
    light: Light = False,
    for_programs: Json = False,
) -> ExitStatus:
    """Show turtle2 following turtle1 (ros2 launch turtle_tf2_py turtle_tf2_demo.launch.py).

    On a terminal: the field, the tree and a pair of frames; the arrow keys drive
    turtle1, [ and ] go back in time, q quits. Without one: plays the scenario on
    simulated time, its own script at the keys, prints what came of it, and exits with 1
    if it did not turn out as the scenario expects.

    tftool demo
    tftool demo carrot --source-frame carrot1
    tftool demo time_travel --rate 2 --set delay=3
    """
    from tftool.cli.hosting import (
        HOME,
        left_to_a_person,
        look_around,
        named,
        scenario_named,
        shared,
    )
    from tftool.cli.onscreen import driver_of, has_terminal, run_app, simulator_of
    from tftool.scenario.play import Watch, build

    if recording is not None and recording.exists():
        # Said before the screen comes up.
        raise UsageError(f"'{recording}' exists: --record takes a name that is free.")
    arguments = _arguments(settings or (), source_frame)
    if scenario is not None and named(scenario).kind.is_recording:
        if arguments or rate != 1.0 or lasting is not None or for_programs:
            raise UsageError(
                "A recording stands still: leave out --set, --source-frame, --rate, --for and "
                "--json. 'tftool play' plays it."
            )
        _show_recording(connection, scenario, ascii_only=ascii_only, light=light)
        return ExitStatus.DONE
    chosen = scenario_named(scenario or HOME, arguments)
    if for_programs or not has_terminal():
        from tftool.scenario.summary import as_json, play_through, written

        if connection.needs_link:
            raise UsageError(
                "Without a terminal the demo plays on simulated time, which cannot be shared. "
                "'tftool monitor' and 'tftool view' share a session without one."
            )
        refuse_long_simulation(lasting)
        defaults = scenario_named(scenario or HOME).arguments if arguments else chosen.arguments
        if recording is None:
            played = play_through(chosen, defaults, lasting)
        else:
            from functools import partial

            from tftool.cli.recording import recorded

            watch = partial(recorded, path=recording)
            played = play_through(chosen, defaults, lasting, watch=watch)
        typer.echo(as_json(played) if for_programs else written(played))
        return ExitStatus.DONE if played.verdict.ok else ExitStatus.FAILED

    from tftool.screens.setting import Setting

    # Without a wish of the user's, what runs here already is shown.
    wanted = scenario or (HOME if arguments or rate != 1.0 else None)
    found = look_around(connection, wanted, needs_turtles=True)
    joined = found.session
    if recording is not None and joined is not None:
        raise UsageError(
            "A session runs here, which 'tftool record' records: --record is for a world of "
            "the demo's own (--host)."
        )
    if joined is not None:
        world, live = joined.world, joined.live

        async def life() -> None:
            await live(None if lasting is None else world.clock.now() + lasting)

        driver: Teleop | None = None if connection.read_only else driver_of(world, "turtle1")
        title = f"tftool demo, in {joined.name}"
    else:
        around: Watch = nullcontext
        if recording is not None:
            from functools import partial

            from tftool.cli.recording import recorded

            around = partial(recorded, path=recording)
        play = build(left_to_a_person(chosen), connection.providers.wall_clock(rate))
        world = play.world
        if found.alone:
            # What was said before the screen came up is hidden behind it.
            world.log.warn("session", found.alone)

        async def life() -> None:
            # Counted from here: the screen takes a while to come up.
            until = None if lasting is None else world.clock.now() + lasting
            with around(world), shared(found.link, world):
                await play.live(until, endless=until is None)

        driver = None if simulator_of(world) is None else driver_of(world, "turtle1")
        title = f"tftool demo {chosen.name}"
    run_app(world, life(), driver, Setting(title=title, ascii_only=ascii_only, light=light))
    return ExitStatus.DONE


def _show_recording(connection: Connection, word: str, *, ascii_only: bool, light: bool) -> None:
    """Show a recording at rest, from its beginning on."""
    from pathlib import Path

    from tftool.cli.hosting import open_session
    from tftool.cli.onscreen import has_terminal, run_app
    from tftool.screens.setting import Setting
    from tftool.views.escaping import visible

    if not has_terminal():
        raise UsageError(
            f"There is no terminal to show it on: 'tftool tree {visible(word)}' prints its "
            f"frames, 'tftool view {visible(word)}' shows them in a browser."
        )
    session = open_session(connection, word)

    async def life() -> None:
        await session.live(None)

    title = f"tftool demo {visible(Path(word).name)}"
    setting = Setting(title=title, ascii_only=ascii_only, light=light, at=session.first_look())
    run_app(session.world, life(), None, setting)


def _arguments(settings: "list[str] | tuple[str, ...]", source_frame: str | None) -> dict[str, str]:
    """Read NAME=VALUE words.

    Raises:
        UsageError: If one is something else, or a name comes twice.
    """
    found: dict[str, str] = {} if source_frame is None else {"source_frame": source_frame}
    for setting in settings:
        name, equals, value = setting.partition("=")
        if not equals or not name:
            raise UsageError(f"--set takes NAME=VALUE, such as --set delay=3, not {setting!r}.")
        if name in found:
            raise UsageError(f"The argument {name!r} is set twice.")
        found[name] = value
    return found
