"""`tftool diff`: what differs between two sets of frames."""

from typing import TYPE_CHECKING, Annotated, Literal

import typer

from tftool.commands.shared.declaration import declare
from tftool.commands.shared.options import OUTPUT, Json, RunFor, not_negative, option

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Connection


@declare(descriptions=True, urdf=True)
def diff(
    connection: "Connection",
    first: Annotated[
        str,
        typer.Argument(
            metavar="A",
            help="A recording, a robot description, a scenario, a launch file or script of static "
            "transforms, or the word 'session' for the one that runs.",
        ),
    ],
    second: Annotated[str, typer.Argument(metavar="B", help="What it is compared with.")],
    millimetres: Annotated[
        float,
        typer.Option(
            "--mm", metavar="MM", callback=not_negative, help="How far a frame may lie elsewhere."
        ),
    ] = 1.0,
    degrees: Annotated[
        float,
        typer.Option(
            "--deg", metavar="DEGREES", callback=not_negative, help="How far it may be turned."
        ),
    ] = 0.1,
    rate_percent: Annotated[
        float | None,
        typer.Option(
            metavar="PERCENT",
            callback=not_negative,
            help="How much a rate may differ; rates do not count if not said.",
        ),
    ] = None,
    align: Annotated[
        Literal["start"] | None,
        option("Compare what moves from each one's own start, not by stamps.", metavar="start"),
    ] = None,
    everything: Annotated[
        bool, option("List links that do not differ, too.", "--all", panel=OUTPUT)
    ] = False,
    lasting: RunFor = None,
    for_programs: Json = False,
    markdown: Annotated[
        bool, option("Print it for an issue on the web.", "--markdown", panel=OUTPUT)
    ] = False,
) -> None:
    """Say what differs between two sets of frames, link by link.

    Links that came, went, hang from another frame, or are static in one and move in the
    other; statics in millimetres and degrees; what moves at the stamps both have: root mean
    square, worst, and when. Exit status 1 when anything differs by more than 1 mm or 0.1°,
    or by --mm, --deg, --rate-percent.

    tftool diff monday.mcap robot.urdf
    tftool diff calibrated.launch.py session --mm 0.5
    tftool diff run1.mcap run2.mcap --align start --json
    """
