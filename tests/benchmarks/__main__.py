"""Every benchmark, on demand: `python -m tests.benchmarks`."""

import platform

from tests.benchmarks import batch, demo, link, scalar, start_up, turtle_world, waits

REPORTS = (
    scalar.report,
    batch.report,
    waits.report,
    start_up.report,
    turtle_world.report,
    demo.report,
    link.report,
)
"""What is measured; add yours."""

if __name__ == "__main__":
    print(f"{platform.python_implementation()} {platform.python_version()}, {platform.machine()}")  # noqa: T201
    for report in REPORTS:
        print(report())  # noqa: T201
