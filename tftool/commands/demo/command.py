"""Implementation of `tftool demo`: a scenario on the screen, or as text without a terminal."""

import asyncio
import sys
from contextlib import nullcontext
from dataclasses import replace
from functools import partial
from pathlib import Path

import typer
from rich.table import Table
from rich.text import Text

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible
from tftool.base.stamps import Stamp
from tftool.commands.demo import DemoOptions
from tftool.commands.shared.connection import HOME, Connection, open_from
from tftool.commands.shared.hosting import JoinDecision, join_or_host
from tftool.commands.shared.notices import notice
from tftool.commands.shared.on_screen import (
    at_rest,
    driver_of,
    run_app,
    screen_lacks,
    screen_setting,
)
from tftool.commands.shared.options import refuse_long_simulation
from tftool.commands.shared.printer import write, write_json
from tftool.drawing.solids import solids_of
from tftool.opener import named, scenario_named
from tftool.recordings.description_frames import prefix_of
from tftool.robots.mesh_folders import MeshFolders
from tftool.scenario import builtin
from tftool.scenario.play import Watch, build, left_to_a_person
from tftool.scenario.scenario import Scenario
from tftool.scenario.summary import as_json, play_through, written
from tftool.screens.still_frames import first_look
from tftool.screens.terminal.scene import Scene, scene_of
from tftool.world.clock import Phase
from tftool.world.link.session_world import shared
from tftool.world.nodes.recorder import recorded
from tftool.world.nodes.turtle_drivers import IdleDrawing
from tftool.world.nodes.turtlesim import simulator_of
from tftool.world.world import World


def _show(
    connection: Connection, options: DemoOptions, chosen: Scenario, name: str | None
) -> str | None:
    """Show a scenario or the running session until the user quits or chooses another scenario.

    Args:
        connection: Connection of the command.
        options: Options of the command.
        chosen: Scenario to show if no session is joined.
        name: Scenario that the user named; None to join the running session if there is one.

    Returns:
        Name of the scenario that the user chose next; None if the user quit.
    """
    found = join_or_host(connection, name, needs_turtles=True)
    if found.session is None:
        return _show_hosted(connection, options, chosen, found)
    if options.recording is not None:
        raise UsageError(
            "--record is only allowed for a demo that hosts its own session (--host): use 'tftool "
            "record' for the running session."
        )
    world, live = found.session.world, found.session.live

    async def life() -> None:
        await live(_end(options, world))

    driver = None if connection.read_only else driver_of(world, "turtle1")
    setting = screen_setting(options, f"tftool demo, in {found.session.name}")
    return run_app(scene_of(world), life(), driver, setting)


def _end(options: DemoOptions, world: World) -> Stamp | None:
    """Return the time at which the demo ends, `options.lasting` from now; None for no end."""
    return None if options.lasting is None else world.clock.now() + options.lasting


def _show_hosted(
    connection: Connection, options: DemoOptions, chosen: Scenario, decision: JoinDecision
) -> str | None:
    """Show a scenario in a new session that other processes can join.

    Returns:
        The scenario that the user chose next; None if the user quit.
    """
    around: Watch = nullcontext
    if options.recording is not None:
        around = partial(recorded, path=options.recording)
    play = build(left_to_a_person(chosen), connection.providers.wall_clock(options.rate))
    world, link = play.world, decision.link
    if decision.not_shared:
        # Notices printed before the screen opens would be hidden behind it.
        world.log.warn("session", decision.not_shared)

    async def life() -> None:
        until = _end(options, world)
        with around(world), shared(link, world):
            await play.live(until, endless=until is None)

    driver = None if simulator_of(world) is None else driver_of(world, "turtle1")
    idle = None
    if driver is not None and not options.still:
        # When another process joins, the turtle stops, so that only that process drives it.
        idle = IdleDrawing(world, is_alone=lambda: link is None or not link.graph.processes())
    setting = replace(
        screen_setting(options, f"tftool demo {chosen.name}"),
        pair=("turtle2", dict(chosen.arguments).get("source_frame", "turtle1")),
        scenarios=None if options.recording is not None else builtin.abouts,
    )
    return run_app(scene_of(world), life(), driver, setting, idle)


def _list(*, for_programs: bool) -> None:
    """Print the built-in scenarios."""
    listed = builtin.abouts()
    if for_programs:
        write_json([{"name": name, "about": about} for name, about in listed], indent=None)
        return
    table = Table.grid(padding=(0, 2), pad_edge=False)
    for name, about in listed:
        table.add_row(Text(name), Text(about))
    write(table)


def _show_recording(connection: Connection, options: DemoOptions, recording: str) -> None:
    """Show a recording, paused at its beginning."""
    if lacking := screen_lacks():
        raise UsageError(
            f"The demo's screen needs a terminal, and {lacking}: "
            f"'tftool tree {visible(recording)}' prints the frames of the recording, "
            f"'tftool view {visible(recording)}' shows the frames in a browser."
        )
    frames = open_from(connection, recording)
    shown = at_rest(connection, frames)

    async def life() -> None:
        await shown.clock.sleep_until(frames.span[1], Phase.WATCH)
        await asyncio.get_running_loop().create_future()

    title = f"tftool demo {visible(Path(recording).name)}"
    setting = screen_setting(options, title, at=first_look(frames))
    scene = Scene(shown)
    if frames.robot is not None:
        robot = frames.robot
        prefix = prefix_of(robot, frames.buffer.frames())
        scene.solids, missing = solids_of(
            robot.links.values(), MeshFolders(), prefix, joints=robot.joints.values()
        )
        if missing:
            shown.log.warn("screen", f"{len(missing)} shapes are not drawn: {missing[0]}")
    run_app(scene, life(), None, setting)


def _arguments(settings: "list[str] | tuple[str, ...]", source_frame: str | None) -> dict[str, str]:
    """Return the NAME=VALUE words of --set as a mapping; `source_frame` is added unless None.

    Raises:
        UsageError: If a word is not NAME=VALUE, or a name is given twice.
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


def run(connection: Connection, options: DemoOptions) -> ExitStatus:
    """Run `tftool demo`: show or play a scenario, a recording or the running session."""
    if options.listing:
        _list(for_programs=options.for_programs)
        return ExitStatus.DONE
    if options.recording is not None and options.recording.exists():
        # Raised before the screen opens.
        raise UsageError(f"'{options.recording}' exists: give --record a new name.")
    arguments = _arguments(options.settings or (), options.source_frame)
    if options.scenario is not None and named(options.scenario).kind.is_recording:
        if arguments or options.rate != 1.0 or options.lasting is not None or options.for_programs:
            raise UsageError(
                "The demo only displays a recording: leave out --set, --source-frame, --rate, "
                "--for and --json. 'tftool play' plays the recording."
            )
        _show_recording(connection, options, options.scenario)
        return ExitStatus.DONE
    chosen = scenario_named(options.scenario or HOME, arguments)
    lacking = screen_lacks()
    if options.for_programs or lacking:
        return _play(connection, options, chosen, lacking)
    # If the user chose nothing, the running session is shown.
    wanted = options.scenario or (HOME if arguments or options.rate != 1.0 else None)
    other = _show(connection, options, chosen, wanted)
    while other is not None:
        other = _show(connection, options, scenario_named(other), other)
    return ExitStatus.DONE


def _play(
    connection: Connection, options: DemoOptions, chosen: Scenario, lacking: str
) -> ExitStatus:
    """Play a scenario on simulated time, and print the outcome.

    Args:
        connection: Connection of the command.
        options: Options of the command.
        chosen: Scenario to play.
        lacking: Reason why no screen can be shown, for the notice.
    """
    if connection.needs_link:
        raise UsageError(
            "Without a terminal, the demo plays on simulated time, which cannot be shared with "
            "other processes: use 'tftool monitor' or 'tftool view', which need no terminal."
        )
    refuse_long_simulation(options.lasting)
    if not options.for_programs and sys.stdout.isatty():
        # A person at the terminal expects a screen.
        notice(
            f"The demo's screen needs a terminal, and {lacking}: the demo plays without a screen."
        )
    defaults = scenario_named(options.scenario or HOME, expects=False).arguments
    around: Watch = nullcontext
    if options.recording is not None:
        around = partial(recorded, path=options.recording)
    played = play_through(chosen, defaults, options.lasting, watch=around)
    typer.echo(as_json(played) if options.for_programs else written(played))
    return ExitStatus.DONE if played.verdict.ok else ExitStatus.FAILED
