"""What the demo costs while turtle1 draws by itself: processor time against time on the wall."""

import fcntl
import os
import pty
import struct
import sys
import tempfile
import termios
import time

SIZES = ((80, 24), (120, 40), (200, 60))
# It draws from 5 s on; the start of both runs, and that of the drawing, cancels out.
SHORT, LONG = 8.0, 20.0
ALLOWED = 15.0


def cost(columns: int, rows: int, duration: float) -> float:
    """Processor seconds of a demo on a terminal of that size that ends after `duration`."""
    folder = tempfile.mkdtemp()
    pid, terminal = pty.fork()
    if pid == 0:
        os.environ["TERM"] = "xterm-256color"
        os.environ["COLORTERM"] = "truecolor"
        # In a session of its own: where others are, nothing draws by itself.
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
    """Measure, and say it in a few lines; a short run beside the long one takes out the start."""
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
