"""Tests of a played recording: the times at which transforms are sent, and the listeners' clock."""

import asyncio

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.recordings.writers import SECOND, Sent, numbers, write_mcap, write_rosbag1
from tftool import open_recording
from tftool.base.stamps import seconds
from tftool.messages.classes import INTERFACES
from tftool.recordings.timeline import Timeline
from tftool.world.clock import FollowedClock, SimClock, run
from tftool.world.nodes.player import Player
from tftool.world.supervisor import live
from tftool.world.world import World

START = 1_750_000_000 * SECOND
LATE = seconds(0.01)
CLOCK = INTERFACES.message("rosgraph_msgs/Clock")


def tick(number, log=None):
    stamp = START + number * SECOND
    moved = (stamp, "odom", "base_link", numbers(number))
    log = stamp + LATE if log is None else log
    return Sent(log, "/tf", (moved,), node="/odometry")


MOUNT = Sent(
    START + SECOND * 3 // 2, "/tf_static", ((0, "base_link", "laser", numbers(77)),), node="/urdf"
)
SENT = [tick(0), tick(1), MOUNT, tick(2), tick(3)]


class Played:
    """A recording, a world whose clock it sets, and the times of the sent transforms."""

    def __init__(self, path, **how):
        with open_recording(path) as recording:
            self.timeline = Timeline(recording.source, recording.transforms)
        self.pace = SimClock(seconds(5000))
        restamped = how.get("is_restamped", False)
        self.world = World(self.pace if restamped else FollowedClock(self.timeline.start))
        self.sent, self.clocks = [], []
        for topic in (self.world.tf, self.world.tf_static):
            topic.subscribe(self.note)
        clock = self.world.topic("clock", CLOCK)
        clock.subscribe(lambda told: self.clocks.append(moment_of(told)))
        self.player = Player(self.world, "player", timeline=self.timeline, pace=self.pace, **how)

    def note(self, message):
        for one in message.transforms:
            passed = (self.pace.now() - seconds(5000)) / SECOND
            self.sent.append((passed, message.authority, one.child_frame_id, one.stamp))

    def run(self, *steps, until=None):
        """Run the world; `steps` call methods of the player at given seconds."""

        async def both():
            living = asyncio.ensure_future(live(self.world))
            for moment, do in steps:
                await self.pace.sleep_until(seconds(5000 + moment))
                do(self.player)
            if until is not None:
                await self.pace.sleep_until(seconds(5000 + until))
                self.world.stop()
            await living

        run(self.pace, both())
        return self


def moment_of(message):
    return message.clock.sec * SECOND + message.clock.nanosec


@pytest.fixture
def file(tmp_path):
    return write_mcap(tmp_path / "run.mcap", SENT)


def children(played, name="base_link"):
    return [
        (passed, (stamp - START) / SECOND)
        for passed, _, child, stamp in played.sent
        if child == name
    ]


def test_transforms_are_sent_when_they_were_received_and_statics_first(file):
    played = Played(file).run()

    assert played.sent[0][1:] == ("player", "laser", 0)
    assert children(played) == [(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0)]
    assert [passed for passed, _, child, _ in played.sent if child == "laser"] == [0.0, 1.49]


def test_twice_the_rate_takes_half_the_time(file):
    assert children(Played(file, rate=2.0).run())[-1] == (1.5, 3.0)


def test_now_is_what_the_recorder_read_and_never_before_what_is_stamped(file):
    played = Played(file)
    ages = []
    played.world.tf.subscribe(
        lambda told: ages.append(played.world.clock.now() - told.transforms[0].stamp)
    )
    played.run()

    assert set(ages) == {LATE}
    assert played.clocks == sorted(played.clocks)
    assert played.clocks[0] == START + LATE
    assert played.clocks[-1] == START + 3 * SECOND + LATE
    assert len(played.clocks) > 3 * 40


def test_the_nodes_of_a_ros_1_bag_send_again(tmp_path):
    played = Played(write_rosbag1(tmp_path / "run.bag", SENT)).run()

    assert {one[1:3] for one in played.sent} == {("/odometry", "base_link"), ("/urdf", "laser")}


def test_a_part_begins_with_what_was_known_by_then(file):
    span = (START + SECOND * 5 // 2, START + SECOND * 4)
    played = Played(file, span=span).run()

    assert children(played) == [(0.0, 1.0), (0.0, 2.0), (0.51, 3.0)]


def test_paused_time_stands_still_and_a_step_sends_one_message(file):
    played = Played(file, is_paused=True).run(
        (1, lambda player: player.step()),
        (2, lambda player: player.step()),
        (3, lambda player: player.resume()),
    )

    # The data of the very beginning is sent; the second step sends the static transform.
    assert children(played) == [(0.0, 0.0), (1.0, 1.0), (3.51, 2.0), (4.51, 3.0)]
    assert [passed for passed, _, child, _ in played.sent if child == "laser"] == [0.0, 2.0]
    assert played.clocks == sorted(played.clocks)


def test_seeking_back_is_told_as_ros_tells_it_and_sends_what_was_known_there(file):
    played = Played(file).run((2.5, lambda player: player.seek(START + seconds(1.2))))

    told = [one.text for one in played.world.log.records if one.level == "WARN"]
    assert told == ["Detected jump back in time. Clearing tf buffer."]
    # Transforms of the second before are sent too, so that lookups between them succeed.
    assert children(played)[3:] == [(2.5, 0.0), (2.5, 1.0), (3.31, 2.0), (4.31, 3.0)]


def test_seeking_goes_no_further_than_the_recording(file):
    played = Played(file, is_paused=True).run(
        (1, lambda player: player.seek(START + seconds(99))),
        (2, lambda player: player.resume()),
    )

    assert [found for found in children(played) if found[0] == 1.0][-1] == (1.0, 3.0)
    # Playing starts again at the end of the recording.
    assert children(played)[-1] == (5.0, 3.0)


@pytest.fixture
def arm(tmp_path):
    """Record a base and an arm, whose transforms are sent alternately."""
    turns = []
    for number in range(4):
        turns.append(tick(number))
        stamp = START + number * SECOND + seconds(0.4)
        turns.append(Sent(stamp, "/tf", ((stamp, "base_link", "arm", numbers(9)),), node="/arm"))
    path = tmp_path / "arm.mcap"
    write_mcap(path, turns)
    return path


def test_where_it_was_sought_links_that_are_sent_in_turns_can_be_asked_together(arm):
    answers = []

    def ask(player):
        answers.append(player.buffer.lookup_transform("odom", "arm").stamp)

    Played(arm, is_paused=True).run(
        (1, lambda player: player.seek(START + seconds(2.2))), (2, ask), until=3
    )

    assert answers == [START + seconds(1.4)]


def test_a_late_subscriber_of_a_paused_player_gets_the_last_transform_of_each_link(arm):
    late = []
    played = Played(arm, is_paused=True)

    played.run(
        (1, lambda player: player.seek(START + seconds(2.2))),
        (2, lambda player: player.world.tf.subscribe(late.append)),
        until=3,
    )

    told = [(one.child_frame_id, one.stamp) for message in late for one in message.transforms]
    assert ("base_link", START + seconds(2)) in told
    assert ("arm", START + seconds(1.4)) in told


def test_at_the_end_it_starts_over_where_that_is_wished(file):
    played = Played(file, is_looping=True).run(until=7)

    assert played.player.laps == 2
    assert children(played).count((3.0, 3.0)) == 1
    assert [stamp for passed, stamp in children(played) if 3.0 < passed < 6.0] == [1.0, 2.0]
    told = [one.text for one in played.world.log.records if one.level == "WARN"]
    assert told == ["Detected jump back in time. Clearing tf buffer."] * 2


def test_restamped_transforms_are_of_the_present_and_no_clock_is_published(file):
    played = Played(file, is_restamped=True, rate=2.0).run()

    assert [stamp for _, _, child, stamp in played.sent if child == "base_link"] == [
        seconds(5000 + 0.5 * number) - LATE for number in range(4)
    ]
    assert played.clocks == []


def test_a_simulations_stamps_are_played_on_its_own_clock(tmp_path):
    sent = [
        Sent(START + number * SECOND, "/tf", ((seconds(20 + number), "odom", "base", numbers(1)),))
        for number in range(3)
    ]
    played = Played(write_mcap(tmp_path / "sim.mcap", sent)).run()

    assert played.clocks[0] == seconds(20)
    assert played.clocks[-1] == seconds(22)


def test_a_simulations_own_clock_counts(tmp_path):
    # The player's clock runs at half the speed of the recorder's.
    sent = []
    for number in range(3):
        stamp, log = seconds(20 + number), START + number * 2 * SECOND
        sent.append(Sent(log, "/clock", clock=stamp))
        sent.append(Sent(log + 1000, "/tf", ((stamp, "odom", "base", numbers(1)),)))
    played = Played(write_mcap(tmp_path / "sim.mcap", sent)).run()

    assert played.clocks[-1] == seconds(22) + 1000
    assert played.sent[-1][0] == pytest.approx(2.0, abs=1e-5)


def test_the_rate_can_be_changed_and_has_bounds(file):
    played = Played(file).run(
        (1, lambda player: player.set_rate(1e9)),
        (1.001, lambda player: player.set_rate(0.5)),
        (1.002, lambda player: player.pause()),
        (9, lambda player: player.resume()),
    )

    assert played.player.rate == 0.5
    assert children(played)[-1][0] == pytest.approx(9 + (3.01 - 1.1 - 0.01) / 0.5, abs=0.03)
