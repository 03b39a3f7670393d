"""Cut and change recordings, and read each copy completely.

`python -m tests.recordings.damaging FILE… [--cuts 1000] [--flips 1000] [--seed 0]`

Each copy must be read, or refused with a sentence, in limited time and memory, without any other
exception. Copies that fail are stored, with the arguments that reproduce the failure.
"""

import argparse
import random
import resource
import signal
import sys
import tempfile
from collections import Counter
from pathlib import Path

from tests.recordings.test_damage import asked

SECONDS = 60
MEGABYTES = 2000


def damaged(raw: bytes, kind: str, draw: random.Random) -> bytes:
    """Return a copy that is cut, or in which one byte is changed."""
    if kind == "cut":
        return raw[: draw.randrange(len(raw))]
    changed = bytearray(raw)
    changed[draw.randrange(len(raw))] ^= draw.randrange(1, 256)
    return bytes(changed)


def attempt(path: Path) -> str:
    """Return the result of reading one copy, in a word."""

    def too_long(*_: object) -> None:
        raise TimeoutError(f"not within {SECONDS} s")

    signal.signal(signal.SIGALRM, too_long)
    signal.alarm(SECONDS)
    try:
        return "refused" if asked(path) is None else "answered"
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    finally:
        signal.alarm(0)


def main(words: list[str]) -> int:
    """Try every file; return the number of copies that failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--cuts", type=int, default=1000)
    parser.add_argument("--flips", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args(words)
    bad = 0
    with tempfile.TemporaryDirectory(prefix="damaging") as folder:
        for file in given.files:
            raw = file.read_bytes()
            if not raw:
                continue
            draw, told = random.Random(f"{file.name} {given.seed}"), Counter[str]()
            copy = Path(folder) / file.name
            for kind in ["cut"] * given.cuts + ["flip"] * given.flips:
                copy.write_bytes(damaged(raw, kind, draw))
                told[f"{kind} {attempt(copy)}"] += 1
            good = ("cut refused", "cut answered", "flip refused", "flip answered")
            bad += sum(count for what, count in told.items() if what not in good)
            peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
            counts = ", ".join(f"{what} {count}" for what, count in sorted(told.items()))
            sys.stdout.write(f"{file.name}: {counts}; at most {peak:.0f} MB\n")
            sys.stdout.flush()
            bad += peak > MEGABYTES
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
