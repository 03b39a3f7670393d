"""Tests of timers and rates."""

import pytest

from tests.ros.spinning import spin


def test_a_timer_can_be_stopped_started_and_asked(node, ros_runtime):
    fired = []
    timer = node.create_timer(1.0, lambda: fired.append(ros_runtime.elapsed()))
    spin(node, 2.5)
    assert timer.time_until_next_call() == 500_000_000
    assert timer.time_since_last_call() == 500_000_000
    timer.cancel()
    assert timer.is_canceled()
    spin(node, 2.0)
    timer.reset()
    spin(node, 1.5)
    timer.timer_period_ns = 250_000_000
    spin(node, 1.0)

    assert fired == [1.0, 2.0, 5.5, 6.5, 6.75, 7.0]
    assert node.destroy_timer(timer)


def test_a_late_timer_skips_what_it_missed_and_stays_on_its_grid(node, ros_runtime):
    fired = []

    def slow():
        fired.append(ros_runtime.elapsed())
        if len(fired) == 1:
            ros_runtime.sleep(2.3)

    node.create_timer(1.0, slow)
    spin(node, 6.0)

    assert fired == [1.0, 3.3, 4.0, 5.0, 6.0]


def test_a_timer_tells_when_it_was_due(node):
    infos = []
    node.create_timer(0.5, lambda info: infos.append(info))
    spin(node, 0.5)

    assert infos[0].expected_call_time == infos[0].actual_call_time


def test_callbacks_and_loops_that_never_wait_still_advance_simulated_time(node, ros_runtime):
    from std_msgs.msg import Int32

    fast = []
    timer = node.create_timer(0, lambda: fast.append(1))
    spin(node, 0.5)
    timer.cancel()
    assert len(fast) == pytest.approx(500, abs=2)

    sender = node.create_publisher(Int32, "numbers", 10)
    while ros_runtime.elapsed() < 0.502:
        sender.publish(Int32())

    node.create_subscription(Int32, "numbers", sender.publish, 10)
    sender.publish(Int32())
    spin(node, 0.002)
    assert ros_runtime.elapsed() == pytest.approx(0.504, abs=0.002)


def test_a_rate_paces_a_loop(node, ros_runtime):
    rate = node.create_rate(4)
    for _ in range(8):
        rate.sleep()

    assert ros_runtime.elapsed() == 2.0
    rate.destroy()
    with pytest.raises(Exception, match="destroyed"):
        rate.sleep()


def test_a_rate_that_is_given_up_is_no_longer_its_nodes(node):
    rate = node.create_rate(4)
    rate.destroy()

    assert not node.destroy_rate(rate)


def test_a_node_that_is_destroyed_has_no_new_rates(node):
    from rclpy.exceptions import InvalidHandle

    node.destroy_node()

    with pytest.raises(InvalidHandle, match="is destroyed"):
        node.create_rate(4)


def test_a_rate_that_is_destroyed_while_it_begins_to_sleep_does_not_sleep(ros_runtime):
    import rclpy
    from rclpy.context import Context

    class Meddling(Context):
        rate = None

        def ok(self):
            if self.rate is not None:
                self.rate.destroy()
            return super().ok()

    context = Meddling()
    rclpy.init(context=context)
    node = rclpy.create_node("probe", context=context)
    context.rate = node.create_rate(1.0)
    before = node.get_clock().now()
    context.rate.sleep()

    assert node.get_clock().now() == before


def test_the_end_of_a_node_ends_its_rates_and_wakes_who_sleeps_by_them(node, ros_runtime):
    asleep, idle = node.create_rate(1e-6), node.create_rate(4)
    sleeper = ros_runtime.start(asleep.sleep)
    ros_runtime.sleep(0.5)
    assert sleeper.status is None
    node.destroy_node()
    ros_runtime.sleep(0.5)

    assert sleeper.status == 0
    assert not node.destroy_rate(asleep)
    for rate in (asleep, idle):
        with pytest.raises(RuntimeError, match="destroyed"):
            rate.sleep()


def time_source(node):
    """Return a clock set by messages, its time source, and a function that sends a time to it."""
    from rclpy.clock import ROSClock
    from rclpy.time import Time
    from rclpy.time_source import TimeSource
    from rosgraph_msgs.msg import Clock

    source, clock = TimeSource(node=node), ROSClock()
    source.attach_clock(clock)
    source.ros_time_is_active = True

    def send(second):
        source.clock_callback(Clock(clock=Time(seconds=second).to_msg()))
        spin(node, 0.1)

    return clock, source, send


def test_a_timer_counts_time_on_the_clock_that_it_is_given(node, ros_runtime):
    clock, source, send = time_source(node)
    fired = []
    timer = node.create_timer(1.0, lambda: fired.append(clock.now().nanoseconds), clock=clock)
    spin(node, 5.0)
    assert fired == []

    # As in rcl: the first time is later than one period; missed calls are skipped; and where time
    # falls back before the last call, a period begins.
    for second in (100.5, 100.75, 101.25, 50.0, 50.75, 51.0):
        send(second)
    assert [moment / 1e9 for moment in fired] == [100.5, 101.25, 51.0]
    assert timer.time_since_last_call() == 0
    assert timer.time_until_next_call() == 10**9

    # Where the source changes, the rest of the period remains.
    fired.clear()
    send(51.75)
    source.ros_time_is_active = False
    start = ros_runtime.elapsed()
    spin(node, 2.0)
    passed = [moment / 1e9 - 1000.0 - start for moment in fired]
    assert passed == pytest.approx([0.25, 1.25])


def test_a_rate_sleeps_on_the_clock_that_it_is_given(tftool, tmp_path):
    file = tmp_path / "paced.py"
    file.write_text(
        "import threading, time\nimport rclpy\nfrom rclpy.clock import ROSClock\n"
        "from rclpy.time import Time\nfrom rclpy.time_source import TimeSource\n"
        "from rosgraph_msgs.msg import Clock\n"
        "rclpy.init()\nnode = rclpy.create_node('paced')\n"
        "source, clock = TimeSource(node=node), ROSClock()\nsource.attach_clock(clock)\n"
        "source.ros_time_is_active = True\nrate, woken = node.create_rate(1.0, clock), []\n"
        "def pace():\n    while len(woken) < 4:\n        rate.sleep()\n"
        "        woken.append(clock.now().nanoseconds / 1e9)\n"
        "thread = threading.Thread(target=pace)\nthread.start()\n"
        "for second in (0.5, 1.5, 1.75, 2.25, 0.5, 1.0, 1.5, 2.5):\n"
        "    source.clock_callback(Clock(clock=Time(seconds=second).to_msg()))\n"
        "    time.sleep(5.0)\n"
        "thread.join()\nnode.get_logger().info(f'woken: {woken}')\n"
    )

    run = tftool("run", "--simulated", "--for", "60", str(file))
    assert "[paced]: woken: [1.5, 2.25, 1.5, 2.5]" in run.err, run.err
