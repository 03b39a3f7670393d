"""Meeting place of this machine's processes: a folder that only its owner may enter.

Every member of a session has a socket in the folder, named after the member. A later process
connects to all members that respond, and removes the sockets of processes that have ended. So there
is no daemon, and every process can end at any time. A process holds a lock while it joins, so that
two processes never both start as the first.

Other users of the machine have no access, because sockets are in folders of mode 700. If a path is
too long for a socket, a short folder of the user is used instead, never a port. On platforms
without Unix sockets, processes connect to ports of the loopback, with a password that is stored in
the folder.
"""

import contextlib
import hashlib
import json
import os
import secrets
import socket
import stat
import sys
import tempfile
import threading
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from tftool.base.errors import LinkError, UsageError

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

FOLDER_VARIABLE: Final = "TFTOOL_SESSION_DIR"
"""Environment variable with another folder; processes with the same folder find each other."""

HAS_UNIX_SOCKETS: Final = sys.platform != "win32" and hasattr(socket, "AF_UNIX")

USER: Final = "tftool"
"""User name with which members log in, if a password guards the folder."""

PASSWORDS: Final = "members"
"""Name of the file with the members' password."""

PAGE_SECRET: Final = "page.secret"
"""Name of the file, in the folder of all sessions, with the secret of this user's pages."""

FRAMES: Final = ".frames"
"""Suffix of files that list a member's frames, for the completion of command lines."""

_MOST_FRAMES = 5_000
_LONGEST_SOCKET_PATH = 100  # 107 on Linux, 103 on macOS
LOCK_TRIES = 1500
"""Number of attempts to take the lock, enough for a busy machine to open a session."""

_LOCK_PAUSE = 0.01
_PROBE_TIMEOUT = 0.2
_LONGEST_TEXT = 256
_LONGEST_LIST = 2**24


def folder(environment: Mapping[str, str] = os.environ) -> Path:
    """Return the folder with this user's sessions.

    The folder is `TFTOOL_SESSION_DIR`, else `tftool` in `XDG_RUNTIME_DIR`, else a folder of the
    user among the temporary files.

    Raises:
        UsageError: If `TFTOOL_SESSION_DIR` is a relative path: commands run in two folders would
            then use different folders, and not find each other.
    """
    named = environment.get(FOLDER_VARIABLE)
    if named:
        if not Path(named).is_absolute():
            raise UsageError(
                f"{FOLDER_VARIABLE}={named!r:.80} is relative, so each command would use "
                "another folder: set it to an absolute path, or unset it."
            )
        return Path(named)
    # The best folder if it exists: in memory, of mode 700, and emptied at logout.
    runtime = environment.get("XDG_RUNTIME_DIR")
    if runtime and Path(runtime).is_absolute():
        return Path(runtime) / "tftool"
    owner = str(os.getuid()) if hasattr(os, "getuid") else environment.get("USERNAME", "user")
    return Path(tempfile.gettempdir()) / f"tftool-{owner}"


def has_members(domain: int, home: Path | None = None) -> bool:
    """Return whether this process could join a local process; remove no files."""
    place = _fitting((folder() if home is None else home) / str(domain))
    with contextlib.suppress(OSError):
        return next(_living(place, sweep=False), None) is not None
    return False


def frames_known(domain: int, home: Path | None = None) -> list[str]:
    """Return the sorted names of the frames that running members of the local session publish.

    The names are read from files that the members write; no session is opened.
    """
    place = _fitting((folder() if home is None else home) / str(domain))
    found: set[str] = set()
    with contextlib.suppress(OSError):
        # Lists of dead members may remain for a while, so only those of living members count.
        members = {_member(Path(endpoint)) for endpoint, _ in _living(place, sweep=False)}
        for path in place.glob(f"*{FRAMES}"):
            if _member(path) in members:
                with contextlib.suppress(ValueError, RecursionError):
                    listed = json.loads(_content_of(path, _LONGEST_LIST))
                    if isinstance(listed, list):
                        found.update(name for name in listed if isinstance(name, str))
    return sorted(found)


def _member(path: Path) -> str:
    """Return the name of the member to which a file or socket belongs."""
    return path.name.partition(".")[0]


class Rendezvous:
    """Membership of one process in the folder where processes of one machine and domain meet.

    Attributes:
        folder: Folder of the members' sockets.
        endpoint: Endpoint of this process, in zenoh's notation.
        password: Password of this folder's members; "" if the sockets' permissions suffice.
        others: Process ids of the other members that responded during `enter`, by endpoint.
    """

    def __init__(self, domain: int, home: Path | None = None) -> None:
        """Choose a member name and a folder; files are only created by `enter`."""
        self.folder = _fitting((folder() if home is None else home) / str(domain))
        self.endpoint = ""
        self.password = ""
        self.others: dict[str, int] = {}
        # The random part distinguishes sessions of one process, and equal ids in two containers.
        self._name = f"{os.getpid()}-{secrets.token_hex(4)}"
        self._lock: Any = None

    def enter(self) -> None:
        """Take the lock, remove files of ended processes, and choose this process's endpoint.

        `settle` releases the lock.

        Raises:
            LinkError: If the folder cannot be created, is open to other users, or has a path too
                long for sockets.
        """
        if HAS_UNIX_SOCKETS and not _holds_sockets(self.folder):
            raise LinkError(
                f"no session can use {self.folder}: the path of a socket there would be longer "
                f"than {_LONGEST_SOCKET_PATH} bytes or contain one of '?#;='; name another folder "
                f"in {FOLDER_VARIABLE}"
            )
        # The parent, too, because a user who may write there could replace the folder.
        _make_private(self.folder.parent)
        _make_private(self.folder)
        try:
            self._take_lock()
            # Under the lock: processes that respond now are members, and later ones will see us.
            self.others = dict(_living(self.folder))
            self.endpoint = self._place()
        except OSError as error:
            self.settle()
            raise LinkError(_unusable(self.folder, error)) from error

    def settle(self) -> None:
        """Release the lock, so that other processes may join."""
        if self._lock is not None:
            self._lock.close()
            self._lock = None

    def tell_frames(self, names: Sequence[str]) -> None:
        """Write the names of this process's frames for `frames_known`; ignore errors."""
        path = self.folder / f"{self._name}{FRAMES}"
        # Renamed when complete, so that a reader never sees half a list.
        fresh = path.with_name(f"{self._name}.new")
        with contextlib.suppress(OSError):
            fresh.write_text(json.dumps(names[:_MOST_FRAMES]), encoding="utf-8")
            fresh.replace(path)

    def leave(self) -> None:
        """Remove this process's files from the folder."""
        self.settle()
        for path in self.folder.glob(f"{self._name}.*"):
            with contextlib.suppress(OSError):
                path.unlink()

    def __enter__(self) -> "Rendezvous":
        self.enter()
        return self

    def __exit__(self, *error: object) -> None:
        self.leave()

    def _take_lock(self) -> None:
        # Stays open: the system releases the lock when the process ends, for any reason.
        self._lock = open(self.folder / "lock", "a+b")  # noqa: SIM115
        pause = threading.Event()
        for _ in range(LOCK_TRIES):
            if _try_lock(self._lock):
                return
            pause.wait(_LOCK_PAUSE)
        # The process that holds the lock is stopped; waiting forever would be worse than a
        # second host in the rarest of cases.

    def _place(self) -> str:
        if HAS_UNIX_SOCKETS:
            return f"unixsock-stream/{self.folder / self._name}.sock"
        self.password = _password_in(self.folder)
        with socket.socket() as probe:
            # The port is free until zenoh binds it; the lock prevents our own processes from
            # taking it.
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        # Port numbers are stored in files like the sockets, and removed the same way.
        (self.folder / f"{self._name}.port").write_text(str(port))
        return f"tcp/127.0.0.1:{port}"


def _living(folder: Path, *, sweep: bool = True) -> Iterator[tuple[str, int]]:
    """Yield the endpoint and process id of each member that responds.

    Args:
        folder: Folder of the members' files.
        sweep: Whether to remove the files of members that do not respond.
    """
    for path in sorted(folder.iterdir()):
        if path.suffix == ".sock":
            if HAS_UNIX_SOCKETS and _answers(socket.AF_UNIX, str(path)):
                yield f"unixsock-stream/{path}", _pid_of(path)
            elif sweep:
                _sweep(path, path.with_name(f"{path.name}.lock"))
        elif path.suffix == FRAMES:
            if sweep and not any(path.with_suffix(one).exists() for one in (".sock", ".port")):
                _sweep(path)
        elif path.suffix == ".port":
            port = _port_in(path)
            if port and _answers(socket.AF_INET, ("127.0.0.1", port)):
                yield f"tcp/127.0.0.1:{port}", _pid_of(path)
            elif sweep:
                _sweep(path)


def _make_private(path: Path) -> None:
    """Create a folder that only its owner may enter, or check that an existing folder is private.

    Raises:
        LinkError: If the folder cannot be created, or other users may enter the folder.
    """
    try:
        path.mkdir(mode=0o700, parents=True, exist_ok=True)
        # Not `stat`, which would follow a symbolic link of another user.
        facts = os.lstat(path)
    except OSError as error:
        raise LinkError(_unusable(path, error)) from error
    if sys.platform == "win32":
        return
    if not stat.S_ISDIR(facts.st_mode) or facts.st_uid != os.getuid():
        raise LinkError(
            f"{path} belongs to another user, so no session can use this folder: name another one "
            f"in {FOLDER_VARIABLE}"
        )
    if facts.st_mode & 0o077:
        raise LinkError(
            f"other users can enter {path} (mode {facts.st_mode & 0o777:03o}), so no session can "
            f"use it: run 'chmod 700' on it, or name another folder in {FOLDER_VARIABLE}"
        )


def _unusable(path: Path, error: OSError) -> str:
    return (
        f"no session can use {path}: {error.strerror or error}; "
        f"name another folder in {FOLDER_VARIABLE}"
    )


def _fitting(place: Path) -> Path:
    """Return the folder for sockets: `place`, or a folder with a shorter path if necessary.

    All processes with the same `place` get the same result.
    """
    if not HAS_UNIX_SOCKETS or _holds_sockets(place):
        return place
    # Every process computes the same name for the same folder.
    name = hashlib.sha256(os.fsencode(place.parent)).hexdigest()[:16]
    return Path("/tmp") / f"tftool-{os.getuid()}-{name}" / place.name


def _holds_sockets(folder: Path) -> bool:
    """Return whether a socket's path in a folder is short enough, and valid for zenoh."""
    longest = len(os.fsencode(folder)) + len("/4194304-01234567.sock")
    return longest <= _LONGEST_SOCKET_PATH and not set("?#;=") & set(str(folder))


def _password_in(folder: Path) -> str:
    """Return the password of a folder's members; the first member creates the password."""
    file = folder / PASSWORDS
    known = _text_of(file).partition(":")[2]
    if known:
        return known
    password = secrets.token_hex(32)
    # Private from its creation; O_EXCL fails if another user has created the file.
    with open(os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as fresh:
        fresh.write(f"{USER}:{password}\n")
    return password


def page_secret(home: Path | None = None) -> str:
    """Return the secret in the addresses of this user's browser pages.

    The secret is stored in the sessions' folder, so that an open page can reconnect to a restarted
    server. If the folder cannot be used, a new secret is returned.
    """
    place = folder() if home is None else home
    file = place / PAGE_SECRET
    fresh = secrets.token_urlsafe(24)
    try:
        _make_private(place)
        with (
            contextlib.suppress(FileExistsError),
            open(os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as made,
        ):
            made.write(fresh)
        known = _text_of(file).strip()
    except (OSError, LinkError):
        return fresh
    return known if len(known) >= len(fresh) else fresh


def is_stopped(pid: int) -> bool:
    """Return whether a process is suspended, has ended, or is not visible to this process."""
    try:
        facts = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return True
    # The state follows the command's name, which may contain any characters.
    return facts.rpartition(")")[2].split()[:1] not in (["R"], ["S"], ["D"])


def _answers(family: int, address: Any) -> bool:
    """Return whether a process listens at an address; a suspended process counts."""
    with socket.socket(family, socket.SOCK_STREAM) as probe:
        probe.settimeout(_PROBE_TIMEOUT)
        try:
            probe.connect(address)
        except (ConnectionRefusedError, FileNotFoundError):
            return False
        except OSError:
            # A full queue or a timeout: the process exists, but is busy.
            return True
    return True


def _pid_of(path: Path) -> int:
    """Return the process id in a file's name; 0 for other names."""
    pid = path.name.partition("-")[0]
    return int(pid) if pid.isascii() and pid.isdigit() and len(pid) < 20 else 0


def _port_in(path: Path) -> int:
    text = _text_of(path)
    return int(text) if text.isascii() and text.isdigit() and 0 < int(text) < 65536 else 0


def _text_of(path: Path) -> str:
    """Return the text of a small file; "" if the file cannot be read."""
    return _content_of(path, _LONGEST_TEXT).decode("ascii", "replace").strip()


def _content_of(path: Path, longest: int) -> bytes:
    """Return a file's first `longest` bytes; b"" for a pipe or device, which could block."""
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0)
    try:
        with open(os.open(path, flags), "rb") as file:
            plain = stat.S_ISREG(os.fstat(file.fileno()).st_mode)
            return file.read(longest) if plain else b""
    except OSError:
        return b""


def _sweep(*paths: Path) -> None:
    for path in paths:
        with contextlib.suppress(OSError):
            path.unlink()


def _try_lock(file: Any) -> bool:
    try:
        if sys.platform == "win32":
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
