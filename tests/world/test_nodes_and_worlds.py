import gc
import math
import weakref

import pytest

from tftool.base.errors import NodeFailed, TftoolError, UsageError
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Pose
from tftool.world.clock import Phase, SimClock, run
from tftool.world.node import Node
from tftool.world.supervisor import live
from tftool.world.world import World


class Ticker(Node):
    def __init__(self, world, name="ticker", *, period=seconds(0.1), immediately=False):
        super().__init__(world, name)
        self.period = period
        self.immediately = immediately
        self.ticks = []

    async def run(self):
        async for now in self.every(self.period, immediately=self.immediately):
            self.ticks.append(now - self.clock.epoch)


class Script(Node):
    """Node that calls one function at one time."""

    phase = Phase.WATCH

    def __init__(self, world, name, at, action):
        super().__init__(world, name)
        self.at = at
        self.action = action

    async def run(self):
        await self.clock.sleep(self.at, self.phase, self.rank)
        self.action()


def lived(world, duration=None):
    until = None if duration is None else world.clock.epoch + duration
    run(world.clock, live(world, until=until))


def transform(child, x=0.0, parent="world", stamp=seconds(1000)):
    return TransformStamped(stamp, parent, child, Transform((x, 0.0, 0.0)))


def test_a_timer_first_fires_one_period_after_its_start_and_in_the_last_instant_too():
    world = World(SimClock())
    ticker = Ticker(world)

    lived(world, seconds(0.3))

    assert ticker.ticks == [seconds(0.1), seconds(0.2), seconds(0.3)]


def test_a_million_ticks_do_not_drift():
    world = World(SimClock())
    ticker = Ticker(world, period=3, immediately=True)

    lived(world, 300_000)

    assert ticker.ticks[0] == 0
    assert ticker.ticks[-1] == 300_000
    assert len(ticker.ticks) == 100_001


def test_a_period_of_nothing_is_refused():
    world = World(SimClock())
    Ticker(world, period=0)
    with pytest.raises(NodeFailed, match="period must be positive"):
        lived(world, 10)


def test_a_period_in_seconds_by_mistake_is_refused():
    world = World(SimClock())
    Ticker(world, period=0.1)
    with pytest.raises(NodeFailed, match=r"whole nanoseconds, not 0\.1"):
        lived(world, 10)


def test_nodes_that_are_due_together_run_in_the_order_they_joined():
    def order():
        world = World(SimClock())
        seen = []
        for name in ("b", "a", "c"):
            Script(world, name, seconds(1), lambda name=name: seen.append(name))
        lived(world)
        return seen

    assert order() == order() == ["b", "a", "c"]


def test_a_run_without_an_end_ends_with_its_last_node():
    world = World(SimClock())
    Script(world, "one", seconds(1), lambda: None)
    Script(world, "two", seconds(7), lambda: None)

    lived(world)

    assert world.clock.elapsed() == seconds(7)


def test_stop_ends_a_run():
    world = World(SimClock())
    Ticker(world)
    Script(world, "stopper", seconds(2), world.stop)

    lived(world)

    assert world.clock.elapsed() == seconds(2)


def test_a_node_that_raises_ends_the_run_and_is_named():
    world = World(SimClock())
    ticker = Ticker(world)

    def explode():
        raise ZeroDivisionError("by zero")

    Script(world, "careless", seconds(1), explode)
    Script(world, "later", seconds(2), explode)

    with pytest.raises(
        NodeFailed, match="node 'careless' failed: ZeroDivisionError: by zero"
    ) as failure:
        lived(world, seconds(10))

    assert failure.value.node == "careless"
    assert isinstance(failure.value.__cause__, ZeroDivisionError)
    assert ticker.ticks[-1] <= seconds(1)


def test_a_subscriber_that_raises_is_blamed_and_not_the_publisher():
    world = World(SimClock())
    listener = Node(world, "listener")
    listener.subscribe("pose", Pose, lambda _: 1 / 0)
    Script(world, "talker", seconds(1), lambda: listener.publish("pose", build(Pose, 0, 0, 0)))

    with pytest.raises(NodeFailed, match="'listener'"):
        lived(world)


def test_the_finally_of_a_node_runs_when_its_world_ends():
    world = World(SimClock())
    ended = []

    class Careful(Node):
        async def run(self):
            try:
                await self.clock.sleep(seconds(100))
            finally:
                await self.clock.sleep(1)
                ended.append(self.name)

    Careful(world, "careful")
    lived(world, seconds(1))
    assert ended == ["careful"]


def test_a_node_that_raises_on_its_way_out_is_named_too():
    world = World(SimClock())

    class Careless(Node):
        async def run(self):
            try:
                await self.clock.sleep(seconds(100))
            finally:
                raise OSError("disk full")

    Careless(world, "careless")
    with pytest.raises(NodeFailed, match="node 'careless' failed: OSError: disk full"):
        lived(world, seconds(1))


def test_a_node_may_join_and_leave_a_living_world():
    world = World(SimClock())
    late = []
    Script(world, "host", seconds(1), lambda: late.append(Ticker(world, "late")))
    Script(world, "bouncer", seconds(1.25), lambda: world.remove(late[0]))

    lived(world, seconds(3))

    assert late[0].ticks == [seconds(1.1), seconds(1.2)]
    assert [node.name for node in world.nodes] == ["host", "bouncer"]


def test_a_node_that_leaves_takes_its_subscriptions_and_services_along():
    world = World(SimClock())
    node = Node(world, "listener")
    node.subscribe("pose", Pose, lambda _: None)
    node.serve("spawn", lambda _: None)
    node.serve_action("rotate", lambda _: None)
    Script(world, "bouncer", seconds(1), lambda: world.remove(node))

    lived(world)

    assert world.topic("pose", Pose).subscribers == 0
    assert not world.has_service("spawn")
    assert not world.actions()


def test_a_node_that_has_left_is_forgotten():
    world = World(SimClock())
    left = []

    def come_and_go():
        node = Ticker(world, "late")
        left.append(weakref.ref(node))
        world.remove(node)

    def look():
        gc.collect()
        left.append(left[0]())

    Script(world, "host", seconds(1), come_and_go)
    Script(world, "looker", seconds(2), look)

    # Without a given end, the world ends when all nodes have ended, including those that ended at
    # once.
    lived(world)

    assert left[1] is None
    assert world.clock.elapsed() == seconds(2)


def test_two_nodes_of_one_name_cannot_live_together():
    world = World(SimClock())
    Node(world, "sim")
    with pytest.raises(TftoolError, match="'sim' exists already"):
        Node(world, "sim")
    assert world.node("sim").name == "sim"
    with pytest.raises(TftoolError, match="no node is named 'nobody'"):
        world.node("nobody")


def test_a_broadcast_of_a_node_reaches_the_buffer_and_the_topic_with_its_name():
    world = World(SimClock())
    node = Node(world, "sender")
    messages = []
    world.tf.subscribe(messages.append)

    node.broadcast(transform("turtle1", 2.0), transform("turtle2"))

    assert world.buffer.lookup_transform("world", "turtle1").transform.translation.x == 2.0
    assert [one.child_frame_id for one in messages[0].transforms] == ["turtle1", "turtle2"]
    assert messages[0].authority == "sender"


def test_a_transform_that_the_buffer_refuses_is_logged_and_not_published():
    world = World(SimClock())
    node = Node(world, "sender")

    node.broadcast(transform("world"))

    assert world.tf.count == 0
    assert "TF_SELF_TRANSFORM" in world.log.records[-1].text


def test_refused_samples_of_ever_new_frames_are_said_a_few_times_and_counted():
    world = World(SimClock())
    node = Node(world, "sender")

    for number in range(10_000):
        node.broadcast(transform(f"f{number}", math.nan))

    told = [one.text for one in world.log.records]
    assert len(told) < 30
    assert "TF_NAN_INPUT" in told[0]
    assert "(1000 similar messages with other names)" in told[-1]


def test_a_listener_that_fails_at_every_message_is_said_once_and_counted():
    world = World(SimClock())
    world.topic("pose", Pose).subscribe(lambda _: 1 / 0, "plotter")

    for _ in range(999):
        world.topic("pose", Pose).publish(Pose())

    told = [one.text for one in world.log.records]
    assert ["100 times so far" in text for text in told] == [False, False, True]


def test_a_node_that_raises_keyboard_interrupt_is_named():
    def interrupt():
        raise KeyboardInterrupt

    world = World(SimClock())
    Script(world, "rash", seconds(1), interrupt)

    with pytest.raises(NodeFailed, match=r"node 'rash' failed: KeyboardInterrupt"):
        lived(world)


def test_a_static_message_always_holds_all_of_its_senders_newest_statics():
    world = World(SimClock())
    node = Node(world, "sender")

    node.broadcast_static(transform("a", 1.0))
    node.broadcast_static(transform("b", 2.0))
    node.broadcast_static(transform("a", 3.0))

    latched = world.tf_static.latest.transforms
    assert [(one.child_frame_id, one.transform.translation.x) for one in latched] == [
        ("a", 3.0),
        ("b", 2.0),
    ]
    assert world.static_transforms() == world.static_transforms("sender") == latched


def test_parameters_keep_their_type_and_tell_of_changes():
    world = World(SimClock())
    node = Node(world, "teleop")
    changes = []
    node.parameters.on_change(lambda name, value: changes.append((name, value)))
    node.declare_parameter("scale_linear", 2.0)

    node.set_parameter("scale_linear", 3)

    assert node.get_parameter("scale_linear") == 3.0
    assert changes == [("scale_linear", 3.0)]
    assert dict(node.parameters.values()) == {"scale_linear": 3.0}
    with pytest.raises(UsageError, match="takes float, not str"):
        node.set_parameter("scale_linear", "fast")
    with pytest.raises(UsageError, match="no parameter 'scale_liner'; did you mean 'scale_linear'"):
        node.set_parameter("scale_liner", 1.0)


def test_a_log_keeps_its_lines_and_hands_them_on():
    world = World(SimClock())
    node = Node(world, "sim")
    heard = []
    stop = world.log.listen(heard.append)

    node.info("Clearing turtlesim.")
    node.warn("odd")
    node.error("wrong")
    world.log.debug("sim", "detail")
    stop()
    node.info("unheard")

    assert [(one.level, one.text) for one in heard] == [
        ("INFO", "Clearing turtlesim."),
        ("WARN", "odd"),
        ("ERROR", "wrong"),
        ("DEBUG", "detail"),
    ]
    assert heard[0].stamp == world.clock.epoch
    assert len(world.log.records) == 5


def test_a_callback_that_fails_while_nobody_runs_the_world_raises_where_it_is():
    world = World(SimClock())
    node = Node(world, "listener")
    node.subscribe("pose", Pose, lambda _: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        node.publish("pose", build(Pose, 0, 0, 0))


def test_an_error_in_a_task_of_a_node_fails_the_node_and_names_the_line():
    world = World(SimClock())

    class Careless(Node):
        async def run(self):
            self.start_soon(self.help())
            await self.clock.sleep(seconds(5))

        async def help(self):
            await self.clock.sleep(seconds(1))
            raise ValueError("no such arm")

    Careless(world, "careless")
    with pytest.raises(
        NodeFailed,
        match=r"node 'careless' failed: ValueError: no such arm \(test_nodes_and_worlds.py:\d+\)",
    ):
        lived(world, seconds(10))
    assert world.clock.elapsed() == seconds(1)


def test_a_task_of_a_node_outlasts_its_run_and_ends_with_the_node():
    world = World(SimClock())
    seen = []

    class Helped(Node):
        async def run(self):
            self.start_soon(self.help())

        async def help(self):
            try:
                async for now in self.every(seconds(1)):
                    seen.append(now - self.clock.epoch)  # noqa: PERF401
            finally:
                seen.append("ended")

    node = Helped(world, "helped")
    Script(world, "bouncer", seconds(2.5), lambda: world.remove(node))
    lived(world)

    assert seen == [seconds(1), seconds(2), "ended"]
    assert world.clock.elapsed() == seconds(2.5)


def test_work_for_a_node_of_a_world_that_does_not_run_is_refused():
    world = World(SimClock())
    node = Node(world, "early")

    async def work():
        raise AssertionError("never begun")

    with pytest.raises(TftoolError, match="node 'early' cannot start work"):
        node.start_soon(work())


def test_a_node_that_awaits_what_another_one_cancelled_has_failed():
    world = World(SimClock())

    class Deceived(Node):
        async def run(self):
            timer = self.clock.timer(self.clock.now() + seconds(1))
            timer.cancel()
            await timer

    Deceived(world, "deceived")
    with pytest.raises(NodeFailed, match=r"'deceived' failed: .* was cancelled"):
        lived(world, seconds(1))


def test_an_observer_that_raises_is_told_of_under_its_own_name_and_harms_no_node():
    world = World(SimClock())
    node = Node(world, "talker")
    world.topic("pose", Pose).subscribe(lambda _: 1 / 0, "plotter")
    heard = []
    world.topic("pose", Pose).subscribe(heard.append)
    Script(world, "hands", seconds(1), lambda: node.publish("pose", build(Pose, 0, 0, 0)))

    lived(world)

    assert len(heard) == 1
    [said] = [record for record in world.log.records if record.level == "ERROR"]
    assert said.node == "plotter"
    assert "ZeroDivisionError: division by zero (test_nodes_and_worlds.py:" in said.text


def test_a_log_listener_that_always_fails_harms_nobody_else():
    world = World(SimClock())
    node = Node(world, "talker")
    heard = []
    world.log.listen(lambda _: 1 / 0, "console")
    world.log.listen(heard.append)

    node.info("one")

    assert [(one.node, one.level) for one in heard] == [("talker", "INFO"), ("console", "ERROR")]


@pytest.mark.parametrize("place", ["topic", "log", "watch", "buffer"])
def test_each_registration_of_one_callback_stands_alone(place):
    world = World(SimClock())
    node = Node(world, "talker")
    called = []

    def callback(*_):
        called.append(place)

    register, act = {
        "topic": (
            world.topic("pose", Pose).subscribe,
            lambda: node.publish("pose", build(Pose, 0, 0, 0)),
        ),
        "log": (world.log.listen, lambda: node.info("said")),
        "watch": (world.watch, lambda: world.topic("new", Pose)),
        "buffer": (world.buffer.listen, lambda: node.broadcast(transform("turtle1"))),
    }[place]
    first = register(callback)
    register(callback)
    first()
    first()
    act()

    assert called == [place]


def test_a_static_that_is_refused_publishes_nothing():
    world = World(SimClock())
    node = Node(world, "sender")

    assert not node.broadcast_static(transform("world"))

    assert world.tf_static.count == 0


def test_a_world_runs_for_a_while_from_now_on():
    world = World(SimClock())
    ticker = Ticker(world)

    world.run(seconds(0.3))
    world.run(seconds(0.2))

    assert world.clock.elapsed() == seconds(0.5)
    assert len(ticker.ticks) == 5
    with pytest.raises(ValueError, match="negative duration"):
        world.run(-1)
    with pytest.raises(TypeError, match="whole nanoseconds"):
        world.run(0.5)


def test_an_end_in_the_past_is_refused():
    world = World(SimClock())
    Ticker(world)

    with pytest.raises(ValueError, match=r"990 s in the past.*world\.run\(seconds\(10\)\)"):
        run(world.clock, live(world, until=seconds(10)))


def test_a_node_that_would_do_nothing_is_refused_as_it_joins():
    class Misspelt(Node):
        async def runn(self):
            pass

    class Blocking(Node):
        def run(self):
            pass

    world = World(SimClock())
    with pytest.raises(TypeError, match="Misspelt has no 'async def run"):
        Misspelt(world, "a")
    with pytest.raises(TypeError, match=r"Blocking.run must be written 'async def run"):
        Blocking(world, "b")
    assert not world.nodes
