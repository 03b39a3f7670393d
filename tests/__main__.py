"""All checks of the project as one command: `python -m tests`.

The order is formatter, linter, layers, plain English, tests; types run beside the tests. Arguments
are passed to pytest: `python -m tests -k history` runs fewer tests. `python -m tests --coverage`
also checks the branch coverage, which takes twice as long.
"""

import os
import subprocess
import sys
from pathlib import Path

PYTHON = [sys.executable, "-m"]
# Many tests wait for other processes, so four at a time keep two processors busy.
WHOLE = ["-n4", "--dist=worksteal"]
COVERAGE = [*WHOLE, "--cov", "--cov-report=term", "--cov-fail-under=90"]

CHECKS = [
    [*PYTHON, "ruff", "format", "--check", "."],
    [*PYTHON, "ruff", "check", "."],
    [str(Path(sys.executable).with_name("lint-imports"))],
    [*PYTHON, "tests.prose"],
]
TYPES = [*PYTHON, "mypy"]
# One process compiles all modules and finds tests that cannot be imported. Without it, several
# workers compile the same modules: 135 seconds of processor time instead of 98.
COLLECT = [*PYTHON, "pytest", "--collect-only", "-qq"]


def main(words: list[str]) -> int:
    """Run every check, the tests last; stop at the first failure, but always report the types."""
    # Several workers share the processors. numpy's BLAS would start a thread for each processor in
    # each process, and these threads wait busily at first.
    environment = {"OPENBLAS_NUM_THREADS": "1", **os.environ}
    root = Path(__file__).resolve().parent.parent
    # A selection of tests covers only a part of the code, so coverage is measured for all tests.
    tests = [*PYTHON, "pytest", *(COVERAGE if words == ["--coverage"] else words or WHOLE)]
    # mypy needs one processor for a minute, and the tests do not use two processors fully.
    with subprocess.Popen(TYPES, cwd=root, stdout=subprocess.PIPE, text=True) as types:
        status = 0
        for command in [*CHECKS, *([] if words else [COLLECT]), tests]:
            print("$", *command, flush=True)  # noqa: T201
            status = subprocess.run(command, cwd=root, env=environment, check=False).returncode
            if status:
                break
        print("$", *TYPES, types.communicate()[0], sep=" ", flush=True)  # noqa: T201
    return status or types.returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
