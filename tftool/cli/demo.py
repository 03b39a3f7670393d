"""`tftool demo`: a scenario on the screen, or, without a terminal, played and summed up."""

from typing import TYPE_CHECKING, Annotated

import typer

from tftool.cli.onscreen import Ascii, Light
from tftool.cli.options import ForPrograms, positive, simulated_seconds, within
from tftool.errors import UsageError

if TYPE_CHECKING:
    from tftool.nodes.teleop import Teleop


def demo(
    scenario: Annotated[
        str | None,
        typer.Argument(
            metavar="[SCENARIO]",
            help="Scenario to play, a built-in name or a file. "
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
        float | None,
        typer.Option(
            "--for",
            metavar="SECONDS",
            callback=positive,
            help="End after so many seconds of the world's time.",
        ),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help="Set any argument of the scenario."),
    ] = None,
    ascii_only: Ascii = False,
    light: Light = False,
    for_programs: ForPrograms = False,
) -> int:
    """Show turtle2 following turtle1 (ros2 launch turtle_tf2_py turtle_tf2_demo.launch.py).

    On a terminal: the field, the tree and a pair of frames; the arrow keys drive
    turtle1, [ and ] go back in time, q quits. Without one: plays the scenario on
    simulated time, its own script at the keys, prints what came of it, and exits with 1
    if it did not turn out as the scenario expects.

    tftool demo
    tftool demo carrot --source-frame carrot1
    tftool demo time_travel --rate 2 --set delay=3
    """
    from tftool.cli.lifetime import shared
    from tftool.cli.onscreen import driver_of, has_terminal, run_app, simulator_of
    from tftool.cli.session import HOME, left_to_a_person, look_around
    from tftool.cli.sharing import choice
    from tftool.runtime.clock import WallClock
    from tftool.scenario.builtin import find
    from tftool.scenario.load import load
    from tftool.scenario.play import build
    from tftool.stamps import seconds

    arguments = _arguments(settings or (), source_frame)
    path = find(scenario or HOME)
    chosen = load(path, arguments)
    duration = None if lasting is None else seconds(lasting)
    if for_programs or not has_terminal():
        from tftool.cli.summary import as_json, play_through, written

        if choice().is_asked_for:
            raise UsageError(
                "Without a terminal the demo plays on simulated time, which nobody can share. "
                "'tftool monitor' and 'tftool view' share a session without one."
            )
        simulated_seconds(lasting)
        defaults = load(path).arguments if arguments else chosen.arguments
        played = play_through(chosen, defaults, duration)
        typer.echo(as_json(played) if for_programs else written(played))
        return 0 if played.verdict.ok else 1

    from tftool.screens.setting import Setting

    # Whoever asks for nothing in particular sees what runs here already.
    named = scenario or (HOME if arguments or rate != 1.0 else None)
    found = look_around(named, needs_turtles=True)
    joined = found.session
    if joined is not None:
        world, live = joined.world, joined.live

        async def life() -> None:
            await live(None if duration is None else world.clock.now() + duration)

        driver: Teleop | None = None if choice().read_only else driver_of(world, "turtle1")
        title = f"tftool demo, in {joined.name}"
    else:
        play = build(left_to_a_person(chosen), WallClock(rate))
        world = play.world
        if found.alone:
            # What was said before the screen came up is hidden behind it.
            world.log.warn("session", found.alone)

        async def life() -> None:
            # Counted from here: the screen takes a while to come up.
            until = None if duration is None else world.clock.now() + duration
            with shared(found.link, world):
                await play.live(until, endless=until is None)

        driver = None if simulator_of(world) is None else driver_of(world, "turtle1")
        title = f"tftool demo {chosen.name}"
    run_app(world, life(), driver, Setting(title=title, ascii_only=ascii_only, light=light))
    return 0


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
