"""Processor time of the demo per second of real time while turtle1 drives by itself."""

import fcntl
import os
import pty
import struct
import sys
import tempfile
import termios
import time

SIZES = ((80, 24), (120, 40), (200, 60))
# turtle1 starts to draw at 5 s. The difference of both runs contains neither the start nor that
# moment.
SHORT, LONG = 8.0, 20.0
ALLOWED = 15.0


def cost(columns: int, rows: int, duration: float) -> float:
    """Return the processor seconds of a demo of `duration` seconds on a terminal of that size."""
    folder = tempfile.mkdtemp()
    pid, terminal = pty.fork()
    if pid == 0:
        os.environ["TERM"] = "xterm-256color"
        os.environ["COLORTERM"] = "truecolor"
        # The session must be empty: turtle1 drives by itself only without other processes.
        os.environ["TFTOOL_SESSION_DIR"] = folder
        os.execv(sys.executable, [sys.executable, "-m", "tftool", "demo", "--for", str(duration)])
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
    while True:
        try:
            if not os.read(terminal, 65536):
                break
        except OSError:  # the other end is closed
            break
    _, status, used = os.wait4(pid, 0)
    os.close(terminal)
    if status:
        raise RuntimeError(f"the demo ended with status {os.waitstatus_to_exitcode(status)}")
    return used.ru_utime + used.ru_stime


def report() -> str:
    """Measure a short and a long run, and print the result; their difference removes the start."""
    lines = ["the demo while turtle1 draws by itself, plots included, share of one core"]
    for columns, rows in SIZES:
        started = time.perf_counter()
        share = (cost(columns, rows, LONG) - cost(columns, rows, SHORT)) / (LONG - SHORT) * 100.0
        lines.append(
            f"  {columns}×{rows}: {share:5.1f} %   (wanted: {ALLOWED:.0f} % at most; "
            f"took {time.perf_counter() - started:.0f} s)"
        )
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())  # noqa: T201
