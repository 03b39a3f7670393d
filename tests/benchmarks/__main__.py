"""Every benchmark, on demand: `python -m tests.benchmarks`."""

import platform

from tests.benchmarks import turtle_world

if __name__ == "__main__":
    print(f"{platform.python_implementation()} {platform.python_version()}, {platform.machine()}")  # noqa: T201
    print(turtle_world.report())  # noqa: T201
