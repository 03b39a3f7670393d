"""Tests of finding each other on one machine, with real folders, sockets and processes."""

import os
import socket
import stat
import subprocess
import sys

import pytest

from tftool.base.errors import LinkError, UsageError
from tftool.world.link.link_options import Options
from tftool.world.link.zenoh import rendezvous
from tftool.world.link.zenoh.middleware import ZenohMiddleware
from tftool.world.link.zenoh.reach import ZenohReach
from tftool.world.link.zenoh.rendezvous import Rendezvous, folder, has_members

unix_only = pytest.mark.skipif(not rendezvous.HAS_UNIX_SOCKETS, reason="needs unix sockets")


@pytest.fixture
def home(tmp_path_factory):
    # The path is short, because the path of a unix socket is limited to about 100 letters.
    return tmp_path_factory.mktemp("s")


def listening(path):
    server = socket.socket(socket.AF_UNIX)
    server.bind(str(path))
    server.listen()
    return server


def path_of(endpoint):
    return endpoint.partition("/")[2]


@pytest.mark.parametrize(
    ("environment", "expected"),
    [
        ({"TFTOOL_SESSION_DIR": "/run/mine", "XDG_RUNTIME_DIR": "/run/user/7"}, "/run/mine"),
        ({"XDG_RUNTIME_DIR": "/run/user/7"}, "/run/user/7/tftool"),
    ],
)
def test_the_folder_is_the_one_named_or_the_users_runtime_folder(environment, expected):
    assert str(folder(environment)) == expected


@pytest.mark.parametrize("named", ["sessions", "./sessions", "../s", "~/sessions", "."])
def test_a_relative_folder_is_refused_as_it_would_be_another_one_everywhere(named):
    with pytest.raises(UsageError, match=r"TFTOOL_SESSION_DIR='.*' is .*an absolute path"):
        folder({"TFTOOL_SESSION_DIR": named})


@unix_only
@pytest.mark.parametrize("environment", [{}, {"XDG_RUNTIME_DIR": "not/absolute"}])
def test_without_a_runtime_folder_it_carries_the_users_number(environment):
    assert folder(environment).name == f"tftool-{os.getuid()}"


@unix_only
def test_the_first_finds_nobody_and_the_second_finds_the_first(home):
    with Rendezvous(0, home / "run") as first:
        assert first.others == {}
        assert stat.S_IMODE(os.stat(first.folder).st_mode) == 0o700
        with listening(path_of(first.endpoint)):
            first.settle()
            with Rendezvous(0, home / "run") as second:
                assert second.others == {first.endpoint: os.getpid()}
                assert second.endpoint != first.endpoint


@unix_only
def test_domains_do_not_meet(home):
    with Rendezvous(0, home / "run") as first, listening(path_of(first.endpoint)):
        first.settle()
        with Rendezvous(1, home / "run") as second:
            assert second.others == {}


@unix_only
def test_a_new_member_removes_the_files_of_a_killed_process(home):
    with Rendezvous(0, home / "run") as first:
        first.settle()
        path = path_of(first.endpoint)
        listening(path).close()
        open(f"{path}.lock", "w").close()
        (first.folder / "99-dead.port").write_text("1")
        (first.folder / "99-odd.port").write_text("no number")

        with Rendezvous(0, home / "run") as second:
            assert second.others == {}
            assert [each.name for each in second.folder.iterdir()] == ["lock"]


def pipe(path):
    os.mkfifo(path)


def endless(path):
    path.symlink_to("/dev/zero")


def bytes_that_are_no_text(path):
    path.write_bytes(b"\xff\xfe\x80")


def digits_of_another_script(path):
    path.write_text("\N{ARABIC-INDIC DIGIT THREE}", encoding="utf-8")


ODD_FILES = [pipe, endless, bytes_that_are_no_text, digits_of_another_script, os.mkdir]


@unix_only
@pytest.mark.parametrize("put", ODD_FILES)
def test_a_port_file_that_is_none_holds_up_and_breaks_nothing(home, put):
    with Rendezvous(0, home / "run") as first:
        first.settle()
        put(first.folder / "99-odd.port")

        assert not has_members(0, home / "run")
        with Rendezvous(0, home / "run") as second:
            assert second.others == {}


@unix_only
@pytest.mark.parametrize("put", ODD_FILES)
def test_a_password_file_that_is_none_is_refused_with_its_folder(home, monkeypatch, put):
    monkeypatch.setattr(rendezvous, "HAS_UNIX_SOCKETS", False)
    folder_ = home / "run" / "0"
    folder_.mkdir(mode=0o700, parents=True)
    (home / "run").chmod(0o700)
    put(folder_ / "members")

    with pytest.raises(LinkError, match=r"no session can use .*run/0"):
        Rendezvous(0, home / "run").enter()


@unix_only
def test_a_member_that_leaves_removes_its_files(home):
    with Rendezvous(0, home / "run") as member, listening(path_of(member.endpoint)):
        pass

    assert [each.name for each in member.folder.iterdir()] == ["lock"]


@unix_only
@pytest.mark.parametrize(
    "put",
    [
        os.mkfifo,
        lambda path: path.write_bytes(b"5"),
        lambda path: path.write_bytes(b"[" * 100_000),
        lambda path: path.write_bytes(b'["odom"'),
    ],
)
def test_a_list_of_frames_that_is_none_holds_up_and_breaks_nothing(home, put):
    with Rendezvous(0, home / "run") as member, listening(path_of(member.endpoint)):
        member.tell_frames(["base"])
        assert rendezvous.frames_known(0, home / "run") == ["base"]
        (file,) = member.folder.glob("*.frames")
        file.unlink()
        put(file)

        assert rendezvous.frames_known(0, home / "run") == []


def test_without_unix_sockets_ports_of_the_loopback_are_filed(home, monkeypatch):
    monkeypatch.setattr(rendezvous, "HAS_UNIX_SOCKETS", False)

    with Rendezvous(0, home / "run") as first:
        first.settle()
        host, port = path_of(first.endpoint).split(":")
        with socket.create_server((host, int(port))), Rendezvous(0, home / "run") as second:
            assert host == "127.0.0.1"
            assert port != "7447"
            assert second.others == {first.endpoint: os.getpid()}
    assert {each.name for each in first.folder.iterdir()} == {"lock", "members"}


@unix_only
@pytest.mark.parametrize("name", ["long" * 30, "what?", "a#b", "a;b", "a=b"])
def test_a_path_that_no_socket_can_have_is_replaced_by_a_short_folder_of_ones_own(home, name):
    with Rendezvous(0, home / name) as first, listening(path_of(first.endpoint)):
        assert first.endpoint.startswith("unixsock-stream/")
        for folder_ in (first.folder, first.folder.parent):
            assert stat.S_IMODE(os.stat(folder_).st_mode) == 0o700
        assert has_members(0, home / name)
        first.settle()
        with Rendezvous(0, home / name) as second, Rendezvous(0, home / f"{name}2") as other:
            assert second.others == {first.endpoint: os.getpid()}
            assert other.others == {}
    for made in (first, other):
        (made.folder / "lock").unlink()
        made.folder.rmdir()
        made.folder.parent.rmdir()


@unix_only
def test_where_the_short_folder_is_another_users_the_session_is_refused(home, monkeypatch):
    place = Rendezvous(0, home / ("long" * 30))
    place.folder.parent.mkdir(mode=0o777)
    place.folder.parent.chmod(0o777)
    try:
        with pytest.raises(LinkError, match="other users can enter /tmp/tftool-"):
            place.enter()
    finally:
        place.folder.parent.rmdir()


def test_without_unix_sockets_only_who_can_read_the_folder_gets_in(session_dir, monkeypatch):
    monkeypatch.setattr(rendezvous, "HAS_UNIX_SOCKETS", False)
    first = ZenohMiddleware(Options(), ZenohReach())
    try:
        first.settle()
        (port,) = [path.read_text() for path in (session_dir / "0").glob("*.port")]
        second = ZenohMiddleware(Options(), ZenohReach())
        try:
            second.settle()
            assert second.wire.neighbours == {first.wire.zid}
        finally:
            second.close()
        monkeypatch.setattr("tftool.world.link.zenoh.middleware.REACHING", 1.0)
        with pytest.raises(LinkError, match="no process answers at"):
            ZenohMiddleware(Options(domain=1), ZenohReach(connect=(f"tcp/127.0.0.1:{port}",)))
        assert first.wire.neighbours == frozenset()
        secret = session_dir / "0" / "members"
        assert stat.S_IMODE(secret.stat().st_mode) == 0o600
    finally:
        first.close()


@unix_only
def test_a_folder_that_others_may_enter_is_refused(home):
    (home / "open").mkdir()
    (home / "open").chmod(0o755)

    with pytest.raises(LinkError, match=r"other users can enter .*mode 755.*chmod 700"):
        Rendezvous(0, home / "open").enter()


@unix_only
def test_a_link_in_place_of_the_folder_is_refused(home):
    (home / "real").mkdir(mode=0o700)
    (home / "link").symlink_to(home / "real")

    with pytest.raises(LinkError, match="belongs to another user"):
        Rendezvous(0, home / "link").enter()


def test_a_folder_that_cannot_be_made_is_named_with_the_reason(home):
    (home / "file").write_text("")

    with pytest.raises(LinkError, match=r"no session can use .*TFTOOL_SESSION_DIR"):
        Rendezvous(0, home / "file" / "run").enter()


@unix_only
def test_a_lock_that_cannot_be_opened_is_no_traceback(home):
    place = Rendezvous(0, home / "run")
    place.folder.mkdir(parents=True, mode=0o700)
    (home / "run").chmod(0o700)
    (place.folder / "lock").mkdir()

    with pytest.raises(LinkError, match="Is a directory"):
        place.enter()


HOLD = """
import sys
from pathlib import Path
from tftool.world.link.zenoh.rendezvous import Rendezvous
place = Rendezvous(0, Path(sys.argv[1]))
place.enter()
print("held", flush=True)
sys.stdin.read()
"""


def is_locked(path):
    import fcntl

    with path.open("a+b") as other:
        try:
            fcntl.flock(other, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            return True
    return False


@unix_only
def test_a_lock_is_waited_for_and_a_killed_holder_does_not_keep_it(home, monkeypatch):
    holder = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(home / "run")],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    )
    try:
        assert holder.stdout.readline() == b"held\n"
        with monkeypatch.context() as impatient:
            impatient.setattr(rendezvous, "LOCK_TRIES", 2)
            blocked = Rendezvous(0, home / "run")
            blocked.enter()
            assert is_locked(blocked.folder / "lock")
            blocked.leave()
    finally:
        holder.kill()
        holder.communicate()

    with Rendezvous(0, home / "run") as member:
        assert is_locked(member.folder / "lock")
        member.settle()
        assert not is_locked(member.folder / "lock")


def test_the_secret_of_a_users_pages_stays_and_is_the_users_alone(tmp_path):
    home = tmp_path / "sessions"
    first = rendezvous.page_secret(home)

    assert rendezvous.page_secret(home) == first
    assert rendezvous.page_secret(tmp_path / "others") != first
    assert len(first) >= 32
    if os.name != "nt":
        assert (home / rendezvous.PAGE_SECRET).stat().st_mode & 0o077 == 0
        assert home.stat().st_mode & 0o077 == 0


def test_where_the_folder_is_open_to_others_the_secret_is_new_each_time(tmp_path):
    home = tmp_path / "sessions"
    home.mkdir(mode=0o777)
    home.chmod(0o777)

    assert rendezvous.page_secret(home) != rendezvous.page_secret(home)
    assert not (home / rendezvous.PAGE_SECRET).exists()
