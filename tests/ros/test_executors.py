"""Tests of executors, tasks, futures and coroutines."""

import pytest

from tests.ros.spinning import spin
from tftool.ros.rclpy.context import Context


def test_a_coroutine_callback_may_await_an_answer(node):
    import rclpy
    from std_srvs.srv import Trigger

    rclpy.get_global_executor().add_node(server := rclpy.create_node("server"))
    server.create_service(
        Trigger, "go", lambda request, response: Trigger.Response(success=True, message="went")
    )
    client = node.create_client(Trigger, "go")
    heard = []

    async def ask():
        answer = await client.call_async(Trigger.Request())
        heard.append(answer.message)

    timer = node.create_timer(0.5, ask)
    spin(node, 0.7)
    timer.cancel()

    assert heard == ["went"]


def test_a_task_runs_on_the_executor_and_keeps_its_result(node):
    import rclpy

    executor = rclpy.get_global_executor()
    executor.add_node(node)

    async def work(number):
        return number * 2

    task = executor.create_task(work, 21)
    plain = executor.create_task(lambda: "done")
    executor.spin_until_future_complete(task, timeout_sec=1.0)
    executor.spin_once_until_future_complete(plain, timeout_sec=1.0)

    assert task.result() == 42
    assert plain.result() == "done"
    broken = executor.create_task(lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        executor.spin_until_future_complete(broken)


def test_a_future_tells_and_can_be_given_up():
    from tftool.ros.rclpy.futures import Future

    told = []
    future = Future()
    future.add_done_callback(told.append)
    assert future.remove_done_callback(told.append)
    future.add_done_callback(lambda one: told.append(one.result()))
    future.set_result(3)
    future.add_done_callback(lambda one: told.append("late"))
    refused = Future()
    refused.set_exception(ValueError("no"))
    given_up = Future()
    given_up.cancel()

    assert told == [3, "late"]
    assert isinstance(refused.exception(), ValueError)
    with pytest.raises(ValueError, match="no"):
        refused.result()
    assert given_up.cancelled()


def test_a_guard_condition_calls_back_once(node):
    called = []
    guard = node.create_guard_condition(lambda: called.append(1))
    guard.trigger()
    guard.trigger()
    spin(node, 0.1)

    assert called == [1]


def test_a_multi_threaded_executor_lets_other_callbacks_through_while_one_blocks(ros_runtime):
    import rclpy
    from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
    from rclpy.executors import MultiThreadedExecutor

    def main():
        rclpy.init()
        node = rclpy.create_node("busy")
        trace = ros_runtime.trace = []

        def slow():
            trace.append(("slow", ros_runtime.elapsed()))
            node.get_clock().sleep_for(rclpy.duration.Duration(seconds=1.2))

        def quick():
            trace.append(("quick", ros_runtime.elapsed()))

        node.create_timer(0.5, slow, callback_group=MutuallyExclusiveCallbackGroup())
        node.create_timer(0.4, quick, callback_group=ReentrantCallbackGroup())
        executor = MultiThreadedExecutor(num_threads=2)
        executor.add_node(node)
        executor.spin()

    ros_runtime.start(main)
    ros_runtime.sleep(2.0)

    assert ros_runtime.trace == [
        ("quick", 0.4),
        ("slow", 0.5),
        ("quick", 0.8),
        ("quick", 1.2),
        ("quick", 1.6),
        ("slow", 1.7),
        ("quick", 2.0),
    ]


def test_a_busy_multi_threaded_executor_goes_on_in_its_next_turn(
    ros_runtime,
):
    import rclpy
    from rclpy.callback_groups import ReentrantCallbackGroup
    from rclpy.executors import MultiThreadedExecutor
    from rclpy.task import Future

    trace = []

    def main():
        rclpy.init()
        node = rclpy.create_node("busy")

        def call():
            trace.append(ros_runtime.elapsed())
            if len(trace) <= 2:
                node.get_clock().sleep_for(rclpy.duration.Duration(seconds=0.9))

        node.create_timer(0.25, call, callback_group=ReentrantCallbackGroup())
        executor = MultiThreadedExecutor(num_threads=2)
        executor.add_node(node)
        executor.spin_until_future_complete(Future(), timeout_sec=0.6)
        executor.spin()

    ros_runtime.start(main)
    ros_runtime.sleep(2.0)

    # Until 1.15 both threads sleep, so the timer is late, and then runs at its usual times again.
    assert trace == [0.25, 0.5, 1.15, 1.25, 1.5, 1.75, 2.0]


def test_a_failing_callback_of_a_multi_threaded_executor_fails_its_program():
    from tftool.base.errors import NodeFailed
    from tftool.ros.testing import RosRuntime

    def main():
        import rclpy

        rclpy.init()
        node = rclpy.create_node("broken")
        node.create_timer(0.5, lambda: 1 / 0)
        executor = rclpy.executors.MultiThreadedExecutor()
        executor.add_node(node)
        executor.spin()

    with RosRuntime() as runtime:
        runtime.start(main)
        with pytest.raises(NodeFailed, match="ZeroDivisionError"):
            runtime.sleep(1)


def test_an_executor_can_be_shut_down(node):
    from rclpy.executors import ShutdownException, SingleThreadedExecutor

    with SingleThreadedExecutor() as executor:
        assert executor.add_node(node)
        assert not executor.add_node(node)
        assert executor.get_nodes() == [node]
    assert executor.get_nodes() == []
    with pytest.raises(ShutdownException):
        executor.spin_once(timeout_sec=0.0)


class Counting(Context):
    """Context that stores the registered callbacks for its shutdown."""

    def __init__(self):
        super().__init__()
        self.told = []

    def on_change(self, callback):
        stop = super().on_change(callback)
        self.told.append(callback)

        def forget():
            self.told.remove(callback)
            stop()

        return forget


def test_an_executor_that_is_shut_down_is_let_go_by_its_context(ros_runtime):
    from rclpy.executors import SingleThreadedExecutor

    context = Counting()
    executor = SingleThreadedExecutor(context=context)
    assert len(context.told) == 1
    executor.shutdown()
    executor.shutdown()

    assert context.told == []


def test_an_executor_without_nodes_is_woken_by_its_own_end(ros_runtime):
    import rclpy
    from rclpy.executors import SingleThreadedExecutor

    rclpy.init()
    executor = SingleThreadedExecutor()
    spinning = ros_runtime.start(executor.spin)
    ros_runtime.sleep(0.5)
    assert spinning.status is None
    executor.shutdown()
    ros_runtime.sleep(0.5)

    assert spinning.status == 0


def test_to_wait_for_a_message_in_another_context_leaves_nothing_there(ros_runtime):
    import rclpy
    from rclpy.wait_for_message import wait_for_message
    from std_msgs.msg import Int32

    rclpy.init(context=(context := Counting()))
    node = rclpy.create_node("probe", context=context)
    before = list(context.told)

    assert wait_for_message(Int32, node, "numbers", time_to_wait=0.5) == (False, None)
    assert (context.told, node.executor) == (before, None)


def test_a_loop_that_only_polls_sees_time_pass(node, ros_runtime):
    import rclpy

    fired = []
    node.create_timer(0.05, lambda: fired.append(1))
    while not fired:
        rclpy.spin_once(node, timeout_sec=0)
    end = node.get_clock().now() + rclpy.duration.Duration(seconds=0.01)
    while node.get_clock().now() < end:
        pass

    assert ros_runtime.elapsed() < 0.2


def test_a_loop_that_only_reads_the_clock_ends_after_a_second_too(node, ros_runtime):
    from rclpy.duration import Duration

    start = node.get_clock().now()
    readings = 0
    while node.get_clock().now() - start < Duration(seconds=1):
        readings += 1

    assert ros_runtime.elapsed() == pytest.approx(1.0, abs=0.1)
    assert readings < 500_000


def test_a_loop_that_waits_for_a_subscription_sees_seconds_pass(node, ros_runtime):
    import rclpy
    from std_msgs.msg import String

    publisher = node.create_publisher(String, "said", 10)
    end = node.get_clock().now() + rclpy.duration.Duration(seconds=5)
    while publisher.get_subscription_count() + node.count_publishers("heard") == 0:
        if node.get_clock().now() > end:
            break

    assert ros_runtime.elapsed() == pytest.approx(5.0, abs=0.1)


def test_a_loop_that_spins_without_waiting_executes_its_timers_on_time(node, ros_runtime):
    import rclpy

    fired = []
    node.create_timer(0.1, lambda: fired.append(ros_runtime.elapsed()))
    while len(fired) < 2:
        rclpy.spin_once(node, timeout_sec=0)

    assert fired == pytest.approx([0.1, 0.2], abs=0.0011)


def test_a_task_can_be_given_up(ros_runtime):
    from tftool.ros.rclpy.futures import Future, Task

    waited = Future()

    async def wait():
        await waited

    task = Task(wait)
    assert task() is waited
    task.cancel()
    assert task.cancelled()
    assert task() is None


def test_a_node_may_be_given_an_executor_or_taken_from_it(node):
    from rclpy.executors import SingleThreadedExecutor

    first, second = SingleThreadedExecutor(), SingleThreadedExecutor()
    node.executor = first
    assert (first.get_nodes(), node.executor) == ([node], first)
    node.executor = first
    node.executor = second
    assert (first.get_nodes(), second.get_nodes()) == ([], [node])
    node.executor = None
    assert (second.get_nodes(), node.executor) == ([], None)


def test_a_future_that_is_set_while_the_executor_looks_wakes_it(node, ros_runtime):
    import rclpy
    from rclpy.callback_groups import ReentrantCallbackGroup
    from rclpy.task import Future

    future = Future()

    class Late(ReentrantCallbackGroup):
        """Future that is completed between the executor's check and its wait."""

        def can_execute(self, entity):
            if not future.done():
                future.set_result("set")
            return True

    node.create_timer(10.0, lambda: None, callback_group=Late())
    rclpy.spin_until_future_complete(node, future)

    assert future.result() == "set"
    assert ros_runtime.elapsed() == 0.0


@pytest.mark.parametrize("line", range(1, 7))
def test_a_callback_that_is_added_while_another_thread_answers_is_called(line):
    import sys
    import threading

    from tftool.ros.rclpy.futures import Future

    future, called, lines = Future(), [], []
    answering = threading.Thread(target=future.set_result, args=(None,))

    def trace(frame, event, argument):
        if frame.f_code is not Future.add_done_callback.__code__:
            return None
        if event == "line":
            lines.append(frame.f_lineno)
            if len(lines) == line:
                answering.start()
                answering.join(timeout=0.1)
        return trace

    sys.settrace(trace)
    try:
        future.add_done_callback(called.append)
    finally:
        sys.settrace(None)
    if answering.ident is None:
        answering.start()
    answering.join()

    assert called == [future]
