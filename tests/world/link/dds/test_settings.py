"""Tests of DDS settings: the command line, ROS 2's variables, and refused combinations."""

import os
import sys
from xml.etree import ElementTree

import pytest

from tests.world.link.dds.conftest import ON_LOOPBACK
from tftool.app.main import main
from tftool.base.errors import LinkError
from tftool.world.link.dds import dds_types as names
from tftool.world.link.dds.participant import Participant
from tftool.world.link.dds.settings import network
from tftool.world.link.graph import Process, Role


def found(config, tag):
    return [dict(one.attrib) or one.text for one in ElementTree.fromstring(config).iter(tag)]


@pytest.mark.parametrize(
    ("places", "environment"),
    [
        ((), {}),
        (("lo",), {}),
        (("127.0.0.1",), {"ROS_LOCALHOST_ONLY": "1"}),
        ((), {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}),
        ((), {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "CYCLONEDDS_URI": "<CycloneDDS/>"}),
        ((), {"ROS_STATIC_PEERS": "192.0.2.7"}),
    ],
)
def test_without_a_word_from_the_user_all_of_it_stays_on_the_loopback(places, environment):
    config = network(places, environment).xml()

    assert found(config, "NetworkInterface") == [{"address": "127.0.0.1"}]
    assert found(config, "Peer") == [{"address": "127.0.0.1"}]
    assert found(config, "AllowMulticast") == ["false"]
    assert found(config, "DontRoute") == ["true"]


def test_peers_are_gone_to_without_multicast():
    config = network(("127.0.0.9", "192.0.2.7"), {"ROS_STATIC_PEERS": "192.0.2.8"})

    assert {"192.0.2.7", "192.0.2.8"} <= set(config.peers)


def test_the_users_own_configuration_is_taken_and_that_is_said():
    config = network((), {"CYCLONEDDS_URI": "file:///etc/dds.xml"})

    assert config.xml() == "file:///etc/dds.xml"
    assert config.notices == (
        "CYCLONEDDS_URI is set: DDS uses the network of that configuration, not the loopback only.",
    )


def test_peers_of_the_environment_are_named_where_they_are_not_gone_to():
    assert (
        "--dds-on 192.0.2.7 connects to it"
        in network((), {"ROS_STATIC_PEERS": "192.0.2.7"}).notices[0]
    )


@pytest.mark.parametrize(
    ("places", "environment", "told"),
    [
        (("192.0.2.7",), {"ROS_LOCALHOST_ONLY": "1"}, "ROS_LOCALHOST_ONLY=1 restricts ROS 2"),
        (("192.0.2.7",), {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}, "unset the variable"),
        ((), {"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"}, "set it to LOCALHOST"),
        ((), {"ROS_AUTOMATIC_DISCOVERY_RANGE": "EVERYWHERE"}, "set it to one of SUBNET, LOCALHOST"),
        (("eth0..9",), {}, "is neither an interface of this machine"),
    ],
)
def test_impossible_network_settings_are_refused_with_advice(places, environment, told):
    with pytest.raises(LinkError, match=told):
        network(places, environment)


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["tree", "--dds-on", "eth0..9"], 3, "is neither an interface of this machine"),
        (["tree", "--dds", "--connect", "tcp/localhost:7447"], 2, "--dds uses DDS"),
        (["tree", "--dds", "--domain", "233"], 2, "233"),
        (["tree", "turtles", "--dds"], 2, "--dds"),
    ],
)
def test_wrong_words_are_refused_with_a_sentence(words, status, told, capsys):
    assert main(words) == status
    said = capsys.readouterr()
    assert told in " ".join((said.err + said.out).replace("│", " ").split())
    assert "Traceback" not in said.err


def test_a_domain_of_the_environment_that_is_none_is_refused(monkeypatch, capsys):
    monkeypatch.setenv("ROS_DOMAIN_ID", "900")

    assert main(["tree", "--dds"]) == 2
    assert "ROS_DOMAIN_ID is '900'" in capsys.readouterr().err


def test_a_missing_package_is_said_with_every_way_out(monkeypatch, capsys):
    ours = "tftool.world.link.dds."
    for name in [one for one in sys.modules if one.startswith(("cyclonedds", ours))]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "cyclonedds", None)

    # The error is the same as for any missing extra.
    assert main(["tree", "--dds"]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "pip install 'tftool-tf2[dds]'" in said
    assert "zenoh-bridge-ros2dds" in said


def test_an_empty_domain_names_those_that_are_in_use(domain, capsys):
    neighbour = Participant(domain, network(()), "neighbour", b"")
    try:
        other = domain % 100 + 1 if domain != 100 else 1
        assert main(["session", "--dds", "--domain", str(other + 100)]) == 0
    finally:
        neighbour.close()
    said = capsys.readouterr().err
    assert "No other DDS program answers" in said
    if os.path.exists("/proc/net/udp"):
        assert str(domain) in said


def test_names_of_topics_types_and_processes_are_read_back():
    assert names.dds_type("tf2_msgs/msg/TFMessage") == "tf2_msgs::msg::dds_::TFMessage_"
    part = names.ros_part("rt/a/b", "std_msgs::msg::dds_::String_")
    assert part == ("rt/", "a/b", "std_msgs/msg/String")
    part = names.ros_part("rq/switchRequest", "std_srvs::srv::dds_::SetBool_Request_")
    assert part == ("rq/", "switch", "std_srvs/srv/SetBool")
    process = Process(3, "ab", 12, 4711, Role.HOST, "demo")
    assert names.process_shown(names.process_data(process), 3, "ab") == process


@pytest.mark.parametrize(
    ("topic", "type_name"),
    [
        ("Square", "ShapeType"),
        ("rt/", "std_msgs::msg::dds_::String_"),
        ("rt/a", "std_msgs::msg::String"),
        ("rq/switch", "std_srvs::srv::dds_::SetBool_Request_"),
        ("rt/\x1b[2J", "../../msg"),
    ],
)
def test_a_dds_topic_that_is_not_of_ros_has_no_ros_part(topic, type_name):
    assert names.ros_part(topic, type_name) is None


def test_our_foreign_peer_has_no_other_network_than_the_loopback():
    assert found(ON_LOOPBACK, "NetworkInterface") == [{"address": "127.0.0.1"}]
