"""Tests of the options for sharing a session: their meaning, and refused combinations."""

import subprocess
import sys
from functools import partial

import pytest

from tests.certificates import certificates, needs_openssl
from tests.command_line import Simulated
from tftool.commands.shared.connection import Connection, Mode, Providers, read
from tftool.commands.shared.declaration import CommandKind


@pytest.fixture
def told():
    """Return a function that returns the connection for some options."""

    return partial(read, "command", CommandKind())


def test_without_options_whatever_fits_is_done(told, monkeypatch):
    monkeypatch.delenv("ROS_DOMAIN_ID", raising=False)

    assert told() == Connection("command", CommandKind())
    assert not told().needs_link


def test_the_domain_comes_from_the_option_then_from_ros_2s_variable(told, monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "42")

    assert told().domain == 42
    assert told(domain=7).domain == 7


@pytest.mark.parametrize("value", ["x", "-1", "233", "99999999999999999999", "４"])
def test_a_domain_in_the_environment_that_is_none_is_named(tftool, monkeypatch, value):
    monkeypatch.setenv("ROS_DOMAIN_ID", value)

    result = tftool("echo", "a", "b", "turtles")

    assert result.status == 2
    assert "ROS_DOMAIN_ID is" in result.err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--join", "--host"], "contradict each other"),
        (["--host", "--read-only"], "leave one out"),
        (["--listen", "7448"], "'7448' is not an endpoint"),
        (["--connect", "http/localhost:1"], "'http/localhost:1' is not an endpoint"),
        (["--connect", "tcp/127.0.0.1"], "'tcp/127.0.0.1' has no port: write tcp/HOST:PORT"),
        (["--listen", "tls/[::1]"], "'tls/[::1]' has no port: write tls/HOST:PORT"),
        (["--listen", "udp/here:"], "'udp/here:' has no port"),
        (["--connect", "tcp/there#iface=lo:1"], "has no port"),
        (["--connect", "tls/there:7448"], "needs --tls-cert, --tls-key and --tls-ca"),
        (["--tls-cert", "pyproject.toml"], "give --tls-cert, --tls-key and --tls-ca together"),
        (["--zenoh-config", "README.md", "--listen", "tcp/0.0.0.0:1"], "sets all endpoints"),
        (["--domain", "233"], "233"),
    ],
)
def test_invalid_connection_options_are_refused_with_status_2(tftool, words, told):
    result = tftool("echo", "a", "b", *words)

    assert result.status == 2
    assert told in result.err


@pytest.mark.parametrize(
    "endpoint",
    ["tcp/[::1]:7448", "ws/0.0.0.0:0", "udp/here:1?rel=1#iface=lo", "unixsock-stream/tmp/place"],
)
def test_an_endpoint_with_all_it_needs_is_taken(told, endpoint):
    assert told(connect=[endpoint]).reach.connect == (endpoint,)


@pytest.mark.parametrize("option", ["--zenoh-config", "--tls-cert", "--tls-key", "--tls-ca"])
def test_a_file_that_is_not_there_cannot_be_read(tftool, option):
    result = tftool("echo", "a", "b", option, "no/where.pem")

    assert result.status == 3
    assert result.err == "tftool: There is no file 'no/where.pem'.\n"


@pytest.mark.parametrize("words", [["echo", "a", "b", "robot"], ["tree", "robot"]])
def test_a_named_world_cannot_be_joined(tftool, words):
    result = tftool(*words, "--join")

    assert result.status == 2
    assert "'robot' is a scenario, which cannot be joined: leave out --join" in result.err


@pytest.mark.parametrize("option", [["--listen", "tcp/127.0.0.1:7999"], ["--read-only"]])
def test_a_world_on_simulated_time_is_not_shared(tftool, option):
    result = tftool("tree", "robot", *option)

    assert result.status == 2
    assert "'robot' is played on simulated time, which other processes cannot share" in result.err


def test_a_zenoh_configuration_that_is_none_is_a_sentence(tftool):
    result = tftool("echo", "a", "b", "--zenoh-config", "README.md")

    assert result.status == 3
    assert "the connection to the session cannot be opened (README.md)" in result.err


@needs_openssl
@pytest.mark.parametrize(
    ("cert", "key", "ca", "refusal"),
    [
        ("own.key", "own.key", "ca.pem", "'{}/own.key' contains no certificate in PEM format."),
        ("own.pem", "own.key", "ca.key", "'{}/ca.key' contains no certificate in PEM format."),
        ("own.pem", "own.ext", "ca.pem", "'{}/own.ext' contains no private key in PEM"),
        (
            "own.pem",
            "locked.key",
            "ca.pem",
            "'{}/locked.key' contains no private key in PEM, or a key",
        ),
        ("own.pem", "ca.key", "ca.pem", "'{0}/ca.key' is not the key of the certificate '{0}/own"),
    ],
)
def test_certificates_that_cannot_serve_are_told_before_anything_is_opened(
    tftool, tmp_path, cert, key, ca, refusal
):
    certificates(tmp_path)
    lock = [
        "openssl",
        "ec",
        "-in",
        "own.key",
        "-aes128",
        "-passout",
        "pass:x",
        "-out",
        "locked.key",
    ]
    subprocess.run(lock, check=True, capture_output=True, cwd=tmp_path)
    files = ["--tls-cert", tmp_path / cert, "--tls-key", tmp_path / key, "--tls-ca", tmp_path / ca]

    result = tftool("echo", "a", "b", "--connect", "tls/localhost:7999", *files)

    assert result.status == 3
    assert result.err.startswith("tftool: " + refusal.format(tmp_path))


@needs_openssl
def test_the_link_gets_what_was_said(told, tmp_path):
    made = certificates(tmp_path)
    files = [made.certificate, made.key, made.authority]

    chosen = told(
        join=True,
        domain=1,
        listen=["tls/0.0.0.0:7448"],
        tls_cert=files[0],
        tls_key=files[1],
        tls_ca=files[2],
        read_only=True,
    )

    assert chosen.mode is Mode.JOIN
    assert chosen.needs_link
    options = chosen.options()
    assert options.reach.listen == ("tls/0.0.0.0:7448",)
    assert options.reach.certificates == made
    assert options.read_only


def test_demo_without_a_terminal_shares_nothing_and_says_so(tftool):
    result = tftool("demo", "turtles", "--listen", "tcp/127.0.0.1:7999")

    assert result.status == 2
    assert "which cannot be shared" in result.err


@pytest.mark.parametrize(
    ("words", "purpose"),
    [
        (["static", "--frame-id", "a", "--child-frame-id", "b"], "publish"),
        (["teleop", "--keys", "up"], "drive"),
        (["follow"], "drive"),
    ],
)
def test_commands_that_publish_or_drive_refuse_read_only(tftool, words, purpose):
    result = tftool(*words, "--read-only")

    assert result.status == 2
    assert f"the only purpose of {words[0]} is to {purpose}: leave out --read-only." in result.err


def test_without_zenoh_a_world_is_hosted_and_joining_says_what_is_missing(
    tftool, monkeypatch, outside
):
    class Linked(Simulated):
        link = Providers.link

    outside["providers"] = Linked()
    monkeypatch.setitem(sys.modules, "zenoh", None)

    hosted = tftool("echo", "world", "turtle1", "--once")
    joined = tftool("echo", "world", "turtle1", "--once", "--join")

    assert hosted.status == 0
    missing = "connections to other processes need the package 'eclipse-zenoh'"
    assert hosted.err.startswith(f"No other process can join this world: {missing}")
    assert joined.status == 3
    assert joined.err.startswith(f"tftool: {missing}")


def test_session_has_nothing_to_host(tftool):
    result = tftool("session", "--host")

    assert result.status == 2
    assert "leave out --host" in result.err


def test_every_command_but_check_says_how_it_shares(tftool):
    assert "--connect" in tftool("echo", "--help-session").out
    assert tftool("check", "--help-session").status == 2
