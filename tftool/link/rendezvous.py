"""Where the processes of one machine find each other: a folder only its owner may enter.

Every member of a session has a socket there, named after itself. Who comes later
connects to all that answer and sweeps away those whose process is gone, so there is
no daemon and nobody whose death matters. A lock held while a process joins keeps two
of them from both believing they are the first.
"""

import contextlib
import os
import secrets
import socket
import stat
import sys
import tempfile
import threading
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Final

from tftool.errors import LinkError

FOLDER_VARIABLE: Final = "TFTOOL_SESSION_DIR"
"""Environment variable that names another folder: processes that share it find each other."""

HAS_UNIX_SOCKETS: Final = sys.platform != "win32" and hasattr(socket, "AF_UNIX")

_LONGEST_SOCKET_PATH = 100  # 107 on Linux, 103 on macOS
_LOCK_TRIES = 300
_LOCK_PAUSE = 0.01
_PROBE_TIMEOUT = 0.2


def folder(environment: Mapping[str, str] = os.environ) -> Path:
    """The folder that holds the sessions of this user.

    `TFTOOL_SESSION_DIR`, else `tftool` in `XDG_RUNTIME_DIR`, else a folder of the
    user's own beside other temporary files.
    """
    named = environment.get(FOLDER_VARIABLE)
    if named:
        return Path(named).absolute()
    runtime = environment.get("XDG_RUNTIME_DIR")
    if runtime and Path(runtime).is_absolute():
        return Path(runtime) / "tftool"
    owner = str(os.getuid()) if hasattr(os, "getuid") else environment.get("USERNAME", "user")
    return Path(tempfile.gettempdir()) / f"tftool-{owner}"


def is_anybody_there(domain: int, home: Path | None = None) -> bool:
    """Whether some process waits to be joined; looks without touching anything."""
    place = (folder() if home is None else home) / str(domain)
    with contextlib.suppress(OSError):
        return next(_living(place, sweep=False), None) is not None
    return False


class Rendezvous:
    """One process's place among the others of its machine and domain.

    Attributes:
        folder: Where the members' sockets are.
        endpoint: Where this process listens, as zenoh writes it.
        others: Where the others listen that were alive when `enter` looked.
    """

    def __init__(self, domain: int, home: Path | None = None) -> None:
        """Choose a place; nothing is touched before `enter`."""
        self.folder = (folder() if home is None else home) / str(domain)
        self.endpoint = ""
        self.others: tuple[str, ...] = ()
        self._name = f"{os.getpid()}-{secrets.token_hex(4)}"
        self._lock: Any = None

    def enter(self) -> None:
        """Take the lock, sweep away what the dead left, and find a place.

        `settle` gives the lock back.

        Raises:
            LinkError: If there is no folder that is the user's own.
        """
        _make_private(self.folder.parent)
        _make_private(self.folder)
        try:
            self._take_lock()
            self.others = tuple(_living(self.folder))
            self.endpoint = self._place()
        except OSError as error:
            self.settle()
            raise LinkError(_unusable(self.folder, error)) from error

    def settle(self) -> None:
        """Give the lock back: others may look now."""
        if self._lock is not None:
            self._lock.close()
            self._lock = None

    def leave(self) -> None:
        """Take away what this process put here."""
        self.settle()
        for path in self.folder.glob(f"{self._name}.*"):
            with contextlib.suppress(OSError):
                path.unlink()

    def __enter__(self) -> "Rendezvous":
        self.enter()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.leave()

    def _take_lock(self) -> None:
        # Kept open: the system takes the lock back when the process dies, however it does.
        self._lock = open(self.folder / "lock", "a+b")  # noqa: SIM115
        pause = threading.Event()
        for _ in range(_LOCK_TRIES):
            if _try_lock(self._lock):
                return
            pause.wait(_LOCK_PAUSE)
        # Whoever holds it is stopped in mid-step; to wait for ever would be worse than a
        # second host in the rarest of cases.

    def _place(self) -> str:
        path = self.folder / f"{self._name}.sock"
        if HAS_UNIX_SOCKETS and _fits_endpoint(path):
            return f"unixsock-stream/{path}"
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        # Port numbers are filed as sockets are: by name, and swept the same way.
        (self.folder / f"{self._name}.port").write_text(str(port))
        return f"tcp/127.0.0.1:{port}"


def _living(folder: Path, *, sweep: bool = True) -> Iterator[str]:
    """Endpoints of those who answer; files of those who do not are swept away."""
    for path in sorted(folder.iterdir()):
        if path.suffix == ".sock":
            if HAS_UNIX_SOCKETS and _answers(socket.AF_UNIX, str(path)):
                yield f"unixsock-stream/{path}"
            elif sweep:
                _sweep(path, path.with_name(f"{path.name}.lock"))
        elif path.suffix == ".port":
            port = _port_in(path)
            if port and _answers(socket.AF_INET, ("127.0.0.1", port)):
                yield f"tcp/127.0.0.1:{port}"
            elif sweep:
                _sweep(path)


def _make_private(path: Path) -> None:
    """Make a folder that only its owner may enter, or see that it is one.

    Raises:
        LinkError: If it cannot be made, or others may enter it.
    """
    try:
        path.mkdir(mode=0o700, parents=True, exist_ok=True)
        facts = os.lstat(path)
    except OSError as error:
        raise LinkError(_unusable(path, error)) from error
    if sys.platform == "win32":
        return
    if not stat.S_ISDIR(facts.st_mode) or facts.st_uid != os.getuid():
        raise LinkError(
            f"{path} is not a folder of yours, so no session can meet there; "
            f"name another one in {FOLDER_VARIABLE}"
        )
    if facts.st_mode & 0o077:
        raise LinkError(
            f"other users may enter {path} (mode {facts.st_mode & 0o777:03o}), so no session can "
            f"meet there; chmod 700 it, or name another folder in {FOLDER_VARIABLE}"
        )


def _unusable(path: Path, error: OSError) -> str:
    return (
        f"no session can meet in {path}: {error.strerror or error}; "
        f"name another folder in {FOLDER_VARIABLE}"
    )


def _fits_endpoint(path: Path) -> bool:
    # The letters that mean something in a zenoh endpoint.
    return len(os.fsencode(path)) <= _LONGEST_SOCKET_PATH and not set("?#;=") & set(str(path))


def _answers(family: int, address: Any) -> bool:
    """Whether a process listens there; one that is stopped counts."""
    with socket.socket(family, socket.SOCK_STREAM) as probe:
        probe.settimeout(_PROBE_TIMEOUT)
        try:
            probe.connect(address)
        except (ConnectionRefusedError, FileNotFoundError):
            return False
        except OSError:
            # A full queue, a time-out: somebody is there, too busy to answer.
            return True
    return True


def _port_in(path: Path) -> int:
    try:
        text = path.read_text()[:8]
    except OSError:
        return 0
    return int(text) if text.isascii() and text.isdigit() and 0 < int(text) < 65536 else 0


def _sweep(*paths: Path) -> None:
    for path in paths:
        with contextlib.suppress(OSError):
            path.unlink()


def _try_lock(file: Any) -> bool:
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
