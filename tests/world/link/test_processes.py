"""Tests of several commands in separate processes on one machine."""

import contextlib
import itertools
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.patience import PATIENCE
from tests.world.link.conftest import new_world, until
from tests.world.link.processes import ROOT, Process, run_here
from tftool.world import clock as clocks
from tftool.world.clock import WallClock
from tftool.world.link.graph import Role
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="kills and looks as POSIX does")


def host():
    return Process("echo", "turtle2", "turtle1", "--rate", "20", "--json")


def sockets(folder):
    place = folder / "0"
    return {path.name for path in place.iterdir()} if place.exists() else set()


def test_the_first_hosts_and_says_so_and_the_others_join():
    with host() as first:
        first.says('"translation"')
        with Process("echo", "turtle2", "turtle1", "--count", 3) as second:
            second.says("Joined the session of 'tftool echo'")
            second.says("At time")
            assert second.end() == 0
    assert "No session is running here: hosting scenario 'turtles'." in first.text


def test_a_static_transform_reaches_who_listens_and_who_comes_later():
    with Process("static", "--z", "3", "--frame-id", "A", "--child-frame-id", "B") as static:
        static.says("Spinning")
        late = run_here("echo", "A", "B", "--once")
        assert late.returncode == 0
        assert "- Translation: [0.000, 0.000, 3.000]" in late.stdout
        with Process("echo", "A", "C") as waiting:
            waiting.says("Waiting for C in A")
            with Process(
                "static", "--x", "1", "--frame-id", "B", "--child-frame-id", "C"
            ) as second:
                second.says("Spinning")
                waiting.says("- Translation: [1.000, 0.000, 3.000]")


def test_keys_move_the_turtle_of_the_host_and_everybody_sees_it():
    with host() as first:
        first.says('"translation"')
        pressed = run_here("teleop", "--keys", "up up")
        assert "Joined the session" in pressed.stderr
        x = float(re.search(r"turtle1 is at x ([\d.]+)", pressed.stdout)[1])
        assert x > 7.5
        seen = run_here("echo", "world", "turtle1", "--once", "--json")
        assert json.loads(seen.stdout)["translation"]["x"] == pytest.approx(x, abs=0.01)


def test_the_tree_of_a_session_names_the_broadcasters_of_the_host():
    with host() as first:
        first.says('"translation"')
        tree = run_here("tree")
        assert "broadcaster1" in tree.stdout
        assert "broadcaster2" in tree.stdout


def test_session_lists_processes_nodes_topics_rates_and_services():
    with host() as first:
        first.says('"translation"')
        found = json.loads(run_here("session", "--json").stdout)
        (process,) = found["processes"]
        assert (process["command"], process["pid"], process["role"]) == ("echo", first.pid, "host")
        assert {"turtlesim", "broadcaster1", "follower"} <= set(process["nodes"])
        assert found["topics"]["tf"]["publishers"] == ["broadcaster1", "broadcaster2"]
        # The publish rate of a slow host is not checked here.
        assert found["topics"]["turtle1/pose"]["rate"] > 0
        assert found["services"]["spawn"]["type"] == "turtlesim/srv/Spawn"
        listing = run_here("session")
        assert not listing.stderr
        text = listing.stdout
        row = rf"tftool echo +process {first.pid} +hosts the world +since \d\d:\d\d:\d\d"
        assert re.search(row, text)
        services = found["services"]
        parameters = [name for name in services if name.endswith("_parameters")]
        actions = [name for name in services if "/_action/" in name]
        assert parameters
        assert actions
        listed = text.split("Services")[1]
        assert re.search(r"^  turtle1/set_pen +turtlesim/srv/SetPen$", listed, re.MULTILINE)
        assert not any(f"  {name}  " in listed for name in [*parameters, *actions])
        # The list is between the heading and the line with the count.
        folded = len(services) - (len(listed.splitlines()) - 2)
        assert listed.endswith(f"and {folded} of parameters and actions (--verbose lists them)\n")
        everything = run_here("session", "--verbose").stdout
        assert all(f"  {name}  " in everything for name in services)
        assert "--verbose" not in everything


def test_session_lists_what_no_topic_can_be_called_and_listens_to_the_rest():
    with Link(Options("stranger")) as stranger:
        session = stranger.middleware.session
        token = f"@ros2_lv/0/{session}/1/2/MP/%/%/node/%a%%b/c::msg::dds_::D_/hash/::"
        hide = stranger.middleware.wire.token(token)
        stranger.settle()
        listed = run_here("session", "--for", "0.1")
        hide()

    assert listed.returncode == 0
    assert "a//b" in listed.stdout


def test_session_says_when_nobody_is_there():
    alone = run_here("session")

    assert alone.returncode == 0
    assert alone.stderr.startswith("No session is running in domain 0")
    assert alone.stdout.splitlines() == ["Processes (0)", "Topics (0)", "Services (0)"]


def test_a_named_world_keeps_to_itself_while_a_session_runs():
    with host() as first:
        first.says('"translation"')
        alone = run_here("echo", "map", "odom", "robot", "--once")
        assert alone.returncode == 0
        assert "this world is not shared" in alone.stderr
        assert "map" not in run_here("tree").stdout


@pytest.mark.parametrize("leave", [Process.interrupt, Process.kill])
def test_a_guest_reports_that_the_host_has_left_and_goes_on_with_the_next_host(leave):
    with host() as first:
        first.says('"translation"')
        with Process("echo", "turtle2", "turtle1", "--rate", "20") as guest:
            guest.says("At time")
            leave(first)
            left = guest.says(f"'tftool echo' (process {first.pid}), which hosted, has left")
            guest.says(
                "Waiting for turtle1 in turtle2: no new transform has arrived since", after=left
            )
            # Only a waiting guest is left, so the next command hosts the session.
            with host() as second:
                second.says("No session is running here: hosting scenario 'turtles'.")
                begun = guest.says(f"'tftool echo' (process {second.pid}) hosts now.")
                guest.says("At time", after=begun)


def test_a_named_world_is_shared_with_those_who_have_none():
    with Process("static", "--x", "1", "--frame-id", "A", "--child-frame-id", "B") as static:
        static.says("Spinning")
        with Process("echo", "map", "odom") as waiting:
            waiting.says("Existing frames so far: B, A.")
            with Process("echo", "map", "B", "robot") as named:
                # The frames are in one session, but in unconnected trees.
                named.says("not part of the same tree")
                waiting.says("- Translation: [0.000, 0.000, 0.000]")


def test_another_domain_is_another_session():
    with host() as first:
        first.says('"translation"')
        other = run_here("echo", "turtle2", "turtle1", "--once", "--domain", "7")
        assert "No session is running here" in other.stderr


def test_joining_where_nothing_runs_says_what_to_do():
    alone = run_here("echo", "turtle2", "turtle1", "--join", "--once")

    assert alone.returncode == 3
    assert "No session is running in domain 0: start one with 'tftool demo'" in alone.stderr
    assert "Traceback" not in alone.stderr


def test_joining_frames_without_turtles_names_what_shows_them():
    with Process("static", "1", "2", "3", "0", "0", "0", "world", "camera") as static:
        static.says("camera in world")
        alone = run_here("follow", "turtle1", "turtle2", "--join")

    assert alone.returncode == 3
    assert "No session with turtles is running" in alone.stderr
    assert "'tftool view' and 'tftool tree --watch' show the frames" in alone.stderr


def test_a_folder_that_cannot_be_used_leaves_hosting_alone(session_dir, monkeypatch):
    (session_dir / "file").write_text("")
    monkeypatch.setenv("TFTOOL_SESSION_DIR", str(session_dir / "file" / "s"))

    alone = run_here("echo", "turtle2", "turtle1", "--once")

    assert alone.returncode == 0
    assert "No other process can join this world: no session can use" in alone.stderr


FULL = """
set -e
mount -t tmpfs -o mode=700,size=64k,nr_inodes=$1 tmpfs "$TFTOOL_SESSION_DIR"
shift
exec "$@" echo world turtle1 --once
"""


def may_mount():
    tried = subprocess.run(
        ["unshare", "-m", "true"] if shutil.which("unshare") else ["false"],
        capture_output=True,
        check=False,
    )
    return tried.returncode == 0


@pytest.mark.skipif(not may_mount(), reason="needs the right to mount a file system")
@pytest.mark.parametrize(
    "files", [2, 3, 4], ids=["no room for the lock", "nor for zenoh's", "nor for the socket"]
)
def test_a_full_disk_leaves_hosting_alone(files):
    alone = subprocess.run(
        ["unshare", "-m", "sh", "-c", FULL, "sh", str(files), sys.executable, "-m", "tftool"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )

    assert alone.returncode == 0, alone.stderr
    (told,) = [line for line in alone.stderr.splitlines() if "No other process can join" in line]
    assert "No space left on device" in told
    assert "Traceback" not in alone.stderr


def test_an_interrupted_host_exits_with_130_and_removes_its_sockets(session_dir):
    with host() as first:
        first.says('"translation"')
        assert len(sockets(session_dir)) == 3
        assert first.interrupt() == 130
    assert sockets(session_dir) == {"lock"}
    assert "Traceback" not in first.text


def test_a_stopped_process_keeps_nobody_from_joining():
    import signal

    with host() as first:
        # The first command hosts the session, so its world must exist before the others start.
        first.says('"translation"')
        with Process("static", "--frame-id", "A", "--child-frame-id", "B") as static:
            static.says("Spinning")
            static.started.send_signal(signal.SIGSTOP)
            try:
                joined = run_here("echo", "turtle2", "turtle1", "--once")
                assert joined.returncode == 0
                assert "Joined" in joined.stderr
                listed = run_here("session", "--for", "0.1")
                assert listed.stderr.startswith(
                    f"Process {static.started.pid} of this machine does not answer"
                )
                assert listed.stdout.startswith("Processes (1)\n")
            finally:
                static.started.send_signal(signal.SIGCONT)


def test_a_host_that_is_stopped_is_named_and_no_second_world_is_hosted():
    import signal

    with host() as first:
        first.says('"translation"')
        first.started.send_signal(signal.SIGSTOP)
        try:
            refused = run_here("echo", "turtle2", "turtle1", "--once")
            apart = run_here("echo", "turtle2", "turtle1", "--once", "--host")
        finally:
            first.started.send_signal(signal.SIGCONT)

    pid = first.started.pid
    assert refused.returncode != 0
    assert "No session is running" not in refused.stderr
    assert f"Process {pid} of this machine does not answer" in refused.stderr
    assert f"kill -CONT {pid}" in refused.stderr
    assert apart.returncode == 0
    assert f"Process {pid} of this machine does not answer" in apart.stderr


def test_a_stopped_process_here_keeps_nobody_from_a_far_end_that_lives(monkeypatch, tmp_path):
    import signal
    import socket

    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    far = Process("follow", "--listen", endpoint)
    with far:
        far.says("Successfully spawned turtle2")
        monkeypatch.setenv("TFTOOL_SESSION_DIR", str(tmp_path / "s"))
        with Process("static", "--frame-id", "A", "--child-frame-id", "B") as stopped:
            stopped.says("Spinning")
            stopped.started.send_signal(signal.SIGSTOP)
            try:
                joined = run_here("echo", "turtle2", "turtle1", "--once", "--connect", endpoint)
            finally:
                stopped.started.send_signal(signal.SIGCONT)

    assert joined.returncode == 0, joined.stderr
    assert "Joined the session of 'tftool follow'" in joined.stderr


ROLES = {
    "host": lambda: Process("follow"),
    "static": lambda: Process("static", "--z", "3", "--frame-id", "A", "--child-frame-id", "B"),
    "guest": lambda: Process("echo", "turtle2", "turtle1", "--rate", "20"),
}
READY = {"host": "Successfully spawned turtle2", "static": "Spinning", "guest": "At time"}
ROUNDS = 12


def test_a_killed_host_is_reported_at_once():
    async def miss(first):
        with Link(Options("test")) as guest:
            world = new_world()
            guest.attach(world, role=Role.GUEST)
            await until(lambda: world.buffer.frame_exists("turtle1"))
            first.started.kill()
            # zenoh itself reports a silent peer only after ten seconds; this test waits for the
            # earlier message.
            told = "which hosted, has left"
            await until(lambda: any(told in one.text for one in world.log.records))

    with host() as first:
        first.says('"translation"')
        clocks.run(WallClock(), miss(first))


async def statics_reach_a_newcomer():
    with Link(Options("test", read_only=True)) as link:
        world = new_world()
        link.attach(world, role=Role.GUEST)
        await until(lambda: world.buffer.frame_exists("B"))


def fresh_answer(guest, after):
    """Wait for an answer that differs from all answers printed before."""
    before = {line for line in guest.lines[:after] if "At time" in line}
    guest.until(
        lambda: any("At time" in line and line not in before for line in guest.lines),
        "another answer",
    )


def test_killing_any_process_leaves_the_others_running_and_a_newcomer_finds_them(session_dir):
    with contextlib.ExitStack() as stack:
        live = {}
        for role in ROLES:
            live[role] = stack.enter_context(ROLES[role]())
            live[role].says(READY[role])
        for role in itertools.islice(itertools.cycle(ROLES), ROUNDS):
            mark = len(live["guest"].lines)
            live[role].kill()
            if role == "host":
                live["guest"].says("which hosted, has left", after=mark)
            assert all(live[name].started.poll() is None for name in ROLES if name != role)
            live[role] = stack.enter_context(ROLES[role]())
            live[role].says(READY[role])
            # The host's messages reach the guest, whether the host or the guest is new.
            fresh_answer(live["guest"], len(live["guest"].lines))
            clocks.run(WallClock(), statics_reach_a_newcomer())
        for process in live.values():
            process.interrupt()
            assert "Traceback" not in process.text
    assert sockets(session_dir) == {"lock"}


def inet_sockets(pid):
    """Return the local addresses of a process's internet sockets, from the kernel's list."""
    inodes = set()
    for descriptor in Path(f"/proc/{pid}/fd").iterdir():
        with contextlib.suppress(OSError):
            target = os.readlink(descriptor)
            if target.startswith("socket:["):
                inodes.add(target[8:-1])
    found = []
    for kind in ("tcp", "tcp6", "udp", "udp6"):
        table = Path(f"/proc/{pid}/net/{kind}")
        rows = table.read_text().splitlines()[1:] if table.exists() else []
        found += [(kind, row.split()[1]) for row in rows if row.split()[9] in inodes]
    return found


@pytest.mark.skipif(not Path("/proc/self/net").exists(), reason="needs Linux's /proc")
def test_a_session_of_this_machine_opens_no_internet_socket_at_all():
    with host() as first:
        first.says('"translation"')
        with Process("echo", "turtle2", "turtle1") as second:
            second.says("At time")
            assert inet_sockets(first.pid) == []
            assert inet_sockets(second.pid) == []


@pytest.mark.skipif(not Path("/proc/self/net").exists(), reason="needs Linux's /proc")
def test_only_the_endpoint_asked_for_is_opened():
    import socket

    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with Process("echo", "turtle2", "turtle1", "--listen", f"tcp/127.0.0.1:{port}") as first:
        first.says("At time")
        assert inet_sockets(first.pid) == [("tcp", f"0100007F:{port:04X}")]


APART = """
set -e
echo 1 > /proc/sys/net/ipv6/conf/all/disable_ipv6 || true
echo 1 > /proc/sys/net/ipv6/conf/default/disable_ipv6 || true
ip link set lo up
ip link add away type veth peer name far
ip addr add 10.9.8.7/24 dev away
ip link set away up
ip link set far up
"$@" echo turtle2 turtle1 >first 2>&1 &
first=$!
until grep -q 'At time' first; do kill -0 $first; sleep 0.1; done
"$@" echo turtle2 turtle1 --count 2
kill -TERM $first
wait $first || true
grep away: /proc/net/dev
"""


def may_unshare():
    if not shutil.which("unshare") or not shutil.which("ip"):
        return False
    tried = subprocess.run(
        ["unshare", "-n", "ip", "link", "add", "away", "type", "veth", "peer", "name", "far"],
        capture_output=True,
        check=False,
    )
    return tried.returncode == 0


@pytest.mark.skipif(not may_unshare(), reason="needs the right to make a network namespace")
def test_no_packet_leaves_by_another_interface(tmp_path):
    done = subprocess.run(
        ["unshare", "-n", "sh", "-c", APART, "sh", sys.executable, "-m", "tftool"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )

    assert done.returncode == 0, done.stdout + done.stderr
    assert "Joined the session" in done.stderr
    counters = done.stdout.splitlines()[-1].split()
    # The name, eight counters of received data, then bytes and packets that were sent
    assert counters[0] == "away:"
    assert counters[9:11] == ["0", "0"]
