"""Compare with Debian's tf2 and print the figures: `python -m tests.differential [WORLDS]`."""

import sys

from tests.differential.compare import compare, missing


def main(words: list[str]) -> int:
    if reason := missing():
        sys.stderr.write(f"nothing to compare with: {reason}\n")
        return 1
    found = compare(range(int(words[0]) if words else 250), 1e-9)
    refused = ", ".join(f"{count} {kind}" for kind, count in sorted(found.refused.items()))
    sys.stdout.write(
        f"{found.questions} questions, {sum(found.refused.values())} of them refused ({refused})\n"
        f"worst difference {found.worst:.2g}\n"
        f"{len(found.disagreements)} disagreements\n"
    )
    for line in found.disagreements[:20]:
        sys.stdout.write(line + "\n")
    return bool(found.disagreements)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
