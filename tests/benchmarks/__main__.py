"""All benchmarks: `python -m tests.benchmarks`; `--only scalar,batch` selects some."""

import argparse
import platform

from tests.benchmarks import (
    batch,
    calibrate,
    demo,
    doctor,
    export,
    link,
    page,
    recordings,
    robots,
    scalar,
    space,
    start_up,
    turtle_world,
    waits,
    wire,
)

REPORTS = {
    "scalar": scalar.report,
    "batch": batch.report,
    "waits": waits.report,
    "start_up": start_up.report,
    "turtle_world": turtle_world.report,
    "demo": demo.report,
    "link": link.report,
    "recordings": recordings.report,
    "robots": robots.report,
    "page": page.report,
    "space": space.report,
    "wire": wire.report,
    "doctor": doctor.report,
    "export": export.report,
    "calibrate": calibrate.report,
}
"""Report functions by the benchmark's name on the command line; add new benchmarks here."""


def chosen(names: str) -> list[str]:
    """Return the names in a list separated by commas, if there are such benchmarks."""
    asked = names.split(",")
    if unknown := [name for name in asked if name not in REPORTS]:
        raise argparse.ArgumentTypeError(
            f"there is no benchmark {', '.join(unknown)}; there are {', '.join(REPORTS)}"
        )
    return asked


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks", description=__doc__)
    parser.add_argument(
        "--only", type=chosen, default=list(REPORTS), metavar="NAMES", help="some, with commas"
    )
    names = parser.parse_args().only
    print(f"{platform.python_implementation()} {platform.python_version()}, {platform.machine()}")  # noqa: T201
    for name in names:
        print(REPORTS[name](), flush=True)  # noqa: T201
