import pytest

from tftool.ros.testing import RosRuntime

SERVER = """
import time

import rclpy
from action_tutorials_interfaces.action import Fibonacci
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class FibonacciServer(Node):

    def __init__(self):
        super().__init__('fibonacci_server')
        self._server = ActionServer(
            self, Fibonacci, 'fibonacci', self.execute,
            goal_callback=self.on_goal, cancel_callback=self.on_cancel,
            callback_group=ReentrantCallbackGroup())

    def on_goal(self, request):
        return GoalResponse.ACCEPT if request.order < 20 else GoalResponse.REJECT

    def on_cancel(self, handle):
        return CancelResponse.ACCEPT

    def execute(self, handle):
        feedback = Fibonacci.Feedback(partial_sequence=[0, 1])
        for i in range(1, handle.request.order):
            if handle.is_cancel_requested:
                handle.canceled()
                return Fibonacci.Result(sequence=feedback.partial_sequence)
            feedback.partial_sequence.append(
                feedback.partial_sequence[i] + feedback.partial_sequence[i - 1])
            handle.publish_feedback(feedback)
            time.sleep(1)
        if handle.request.order == 3:
            handle.abort()
            return Fibonacci.Result()
        handle.succeed()
        return Fibonacci.Result(sequence=feedback.partial_sequence)


rclpy.init()
rclpy.spin(FibonacciServer(), executor=MultiThreadedExecutor())
"""


@pytest.fixture
def client(ros_runtime, tmp_path):
    import rclpy
    from action_tutorials_interfaces.action import Fibonacci
    from rclpy.action import ActionClient

    file = tmp_path / "server.py"
    file.write_text(SERVER)
    ros_runtime.start(file)
    rclpy.init()
    client = ActionClient(rclpy.create_node("client"), Fibonacci, "fibonacci")
    assert client.wait_for_server(timeout_sec=5.0)
    return client


def order(number):
    from action_tutorials_interfaces.action import Fibonacci

    return Fibonacci.Goal(order=number)


def finish(client, future):
    import rclpy

    rclpy.spin_until_future_complete(client.node_state.ros_node, future, timeout_sec=60.0)
    return future.result()


def test_a_goal_is_worked_on_with_feedback_and_a_result(client, ros_runtime):
    heard = []
    handle = finish(
        client,
        client.send_goal_async(
            order(6), feedback_callback=lambda m: heard.append(list(m.feedback.partial_sequence))
        ),
    )
    assert handle.accepted
    result = finish(client, handle.get_result_async())

    assert list(result.result.sequence) == [0, 1, 1, 2, 3, 5, 8]
    assert result.status == 4
    assert heard[-1] == [0, 1, 1, 2, 3, 5, 8]
    assert len(heard) == 5
    assert 5.0 <= ros_runtime.elapsed() < 5.1


def test_a_goal_can_be_cancelled_on_the_way(client):
    handle = finish(client, client.send_goal_async(order(15)))
    result = handle.get_result_async()
    import rclpy
    from rclpy.task import Future

    rclpy.spin_until_future_complete(client.node_state.ros_node, Future(), timeout_sec=3.5)
    answer = finish(client, handle.cancel_goal_async())

    assert len(answer.goals_canceling) == 1
    assert finish(client, result).status == 5
    assert len(finish(client, handle.cancel_goal_async()).goals_canceling) == 0


def test_a_goal_can_be_refused_or_given_up(client):
    assert not finish(client, client.send_goal_async(order(50))).accepted
    handle = finish(client, client.send_goal_async(order(3)))

    assert handle.get_result().status == 6
    assert client.send_goal(order(2)).status == 4


def test_goals_of_the_wrong_kind_and_servers_that_are_not_there(client):
    from rclpy.action import ActionClient, ActionServer
    from std_srvs.srv import Trigger  # noqa: F401

    with pytest.raises(TypeError, match="Expected"):
        client.send_goal_async("ten")
    with pytest.raises(TypeError, match="execute_callback"):
        ActionServer(client.node_state.ros_node, client.type_, "x", None)
    nobody = ActionClient(client.node_state.ros_node, client.type_, "nobody")
    assert not nobody.wait_for_server(timeout_sec=0.5)
    import rclpy

    future = nobody.send_goal_async(order(1))
    rclpy.spin_until_future_complete(client.node_state.ros_node, future, timeout_sec=0.5)
    assert not future.done()
    nobody.destroy()


def test_an_answer_that_is_no_result_is_said_and_replaced(tmp_path):
    file = tmp_path / "server.py"
    file.write_text(
        SERVER.replace("return Fibonacci.Result(sequence=feedback.partial_sequence)", "return 3")
    )
    with RosRuntime() as runtime:
        import rclpy
        from action_tutorials_interfaces.action import Fibonacci
        from rclpy.action import ActionClient

        runtime.start(file)
        rclpy.init()
        client = ActionClient(rclpy.create_node("client"), Fibonacci, "fibonacci")
        client.wait_for_server()
        assert list(client.send_goal(order(1)).result.sequence) == []

        assert "must return Fibonacci.Result, not int" in runtime.log("fibonacci_server")[0]


def test_a_server_is_asked_to_cancel_once_each_time_a_client_asks(ros_runtime):
    import rclpy
    from action_tutorials_interfaces.action import Fibonacci
    from rclpy.action import ActionClient, ActionServer, CancelResponse
    from rclpy.task import Future

    rclpy.init()
    node = rclpy.create_node("both")
    asked, end = [], Future()

    async def work(handle):
        await end
        handle.succeed()
        return Fibonacci.Result()

    def on_cancel(handle):
        asked.append(handle)
        return CancelResponse.REJECT

    ActionServer(node, Fibonacci, "fib", work, cancel_callback=on_cancel)
    client = ActionClient(node, Fibonacci, "fib")
    handle = finish(client, client.send_goal_async(order(1)))
    for count in (1, 2):
        answer = finish(client, handle.cancel_goal_async())
        assert len(asked) == count
        assert answer.return_code == answer.ERROR_REJECTED
        assert len(answer.goals_canceling) == 0
    end.set_result(None)
    assert finish(client, handle.get_result_async()).status == 4


def test_a_servers_callbacks_may_be_coroutines_and_a_failing_one_ends_its_goal_alone(ros_runtime):
    import rclpy
    from action_tutorials_interfaces.action import Fibonacci
    from rclpy.action import ActionClient, ActionServer, GoalResponse

    rclpy.init()
    node = rclpy.create_node("both")

    async def on_goal(request):
        return GoalResponse.ACCEPT if request.order < 9 else GoalResponse.REJECT

    async def on_accepted(handle):
        handle.execute()

    def work(handle):
        if handle.request.order == 2:
            raise ValueError("two is one too many")
        handle.succeed()
        return Fibonacci.Result()

    ActionServer(
        node, Fibonacci, "fib", work, goal_callback=on_goal, handle_accepted_callback=on_accepted
    )
    client = ActionClient(node, Fibonacci, "fib")

    assert not finish(client, client.send_goal_async(order(9))).accepted
    assert client.send_goal(order(2)).status == 6
    assert client.send_goal(order(1)).status == 4
    error, warning = ros_runtime.log("both")
    assert "Error raised in execute callback: ValueError: two is one too many" in error
    assert "test_actions.py" in error
    assert warning == "Goal state not set, assuming aborted."


@pytest.mark.parametrize(
    ("before", "instead"),
    [
        (
            "return GoalResponse.ACCEPT if request.order < 20 else GoalResponse.REJECT",
            "raise ValueError('no')",
        ),
        (
            "rclpy.spin(FibonacciServer(), executor=MultiThreadedExecutor())",
            "node = FibonacciServer(); time.sleep(1); node.destroy_node(); time.sleep(60)",
        ),
    ],
    ids=["fails", "leaves"],
)
def test_a_goal_is_refused_by_a_server_that_fails_or_leaves_before_it_decides(
    ros_runtime, tmp_path, before, instead
):
    import rclpy
    from action_tutorials_interfaces.action import Fibonacci
    from rclpy.action import ActionClient

    file = tmp_path / "server.py"
    file.write_text(SERVER.replace(before, instead))
    ros_runtime.start(file, on_exit=lambda program: None)
    rclpy.init()
    client = ActionClient(rclpy.create_node("client"), Fibonacci, "fibonacci")
    assert client.wait_for_server(timeout_sec=5.0)

    assert not finish(client, client.send_goal_async(order(1))).accepted
    assert ros_runtime.elapsed() < 5


def test_a_cancellation_that_is_never_decided_is_refused_when_its_server_leaves(ros_runtime):
    import rclpy
    from action_tutorials_interfaces.action import Fibonacci
    from rclpy.action import ActionClient, ActionServer
    from rclpy.task import Future

    rclpy.init()
    node = rclpy.create_node("both")
    end = Future()

    async def work(handle):
        await end
        return Fibonacci.Result()

    def on_cancel(handle):
        server.destroy()
        raise ValueError("no")

    server = ActionServer(node, Fibonacci, "fib", work, cancel_callback=on_cancel)
    client = ActionClient(node, Fibonacci, "fib")
    handle = finish(client, client.send_goal_async(order(1)))
    answer = handle.cancel_goal_async()
    with pytest.raises(ValueError, match="no"):
        finish(client, answer)

    assert finish(client, answer).return_code == 1


def test_servers_and_clients_of_an_action_are_listed_by_node_name(node):
    import rclpy
    from action_tutorials_interfaces.action import Fibonacci
    from rclpy.action import (
        ActionClient,
        ActionServer,
        get_action_client_names_and_types_by_node,
        get_action_names_and_types,
        get_action_server_names_and_types_by_node,
    )
    from rclpy.node import NodeNameNonExistentError

    other = rclpy.create_node("other", namespace="/far")
    ActionServer(node, Fibonacci, "count", lambda goal: Fibonacci.Result())
    ActionClient(other, Fibonacci, "/count")
    count = [("/count", ["action_tutorials_interfaces/action/Fibonacci"])]

    assert get_action_names_and_types(other) == count
    assert get_action_server_names_and_types_by_node(other, "probe", "/") == count
    assert get_action_server_names_and_types_by_node(node, "other", "/far") == []
    assert get_action_client_names_and_types_by_node(node, "other", "/far") == count
    with pytest.raises(NodeNameNonExistentError, match="'/nobody'"):
        get_action_client_names_and_types_by_node(node, "nobody", "/")


def test_the_services_and_topics_that_ros_2_makes_of_an_action_are_there(client):
    import rclpy
    from action_msgs.msg import GoalInfo
    from action_msgs.srv import CancelGoal
    from action_tutorials_interfaces.action import Fibonacci
    from rclpy.qos import qos_profile_action_status_default
    from unique_identifier_msgs.msg import UUID

    node, made = rclpy.create_node("looks_behind"), Fibonacci.Impl
    fed, states = [], []
    node.create_subscription(made.FeedbackMessage, "fibonacci/_action/feedback", fed.append, 10)
    node.create_subscription(
        made.GoalStatusMessage,
        "fibonacci/_action/status",
        lambda message: states.append([one.status for one in message.status_list]),
        qos_profile_action_status_default,
    )
    send = node.create_client(made.SendGoalService, "fibonacci/_action/send_goal")
    ask = node.create_client(made.GetResultService, "fibonacci/_action/get_result")
    stop = node.create_client(CancelGoal, "fibonacci/_action/cancel_goal")
    goal_id = UUID(uuid=[7] * 16)

    def answer(future):
        rclpy.spin_until_future_complete(node, future, timeout_sec=30)
        return future.result()

    # The goal of this node's own client is in the list too, with the id of its handle.
    handle = finish(client, client.send_goal_async(order(2)))
    assert answer(ask.call_async(made.GetResultService.Request(goal_id=handle.goal_id))).status == 4
    assert [one.goal_id for one in fed] == [handle.goal_id]
    assert states == [[2], [4]]

    asked = made.SendGoalService.Request(goal_id=goal_id, goal=order(9))
    assert answer(send.call_async(asked)).accepted
    assert not answer(send.call_async(asked)).accepted
    result = ask.call_async(made.GetResultService.Request(goal_id=goal_id))
    canceled = answer(stop.call_async(CancelGoal.Request(goal_info=GoalInfo(goal_id=goal_id))))
    assert [one.goal_id for one in canceled.goals_canceling] == [goal_id]
    assert answer(result).status == 5
    assert list(answer(result).result.sequence)[:2] == [0, 1]
    assert {one.goal_id.uuid.tobytes() for one in fed[1:]} == {bytes([7] * 16)}
    assert states[-1] == [4, 5]
    names = dict(node.get_service_names_and_types())
    assert names["/fibonacci/_action/send_goal"] == [
        "action_tutorials_interfaces/action/Fibonacci_SendGoal"
    ]


def test_both_ends_of_an_action_know_a_goal_by_one_id(ros_runtime, node):
    import rclpy
    from action_tutorials_interfaces.action import Fibonacci
    from rclpy.action import ActionClient, ActionServer
    from unique_identifier_msgs.msg import UUID

    seen = []

    def execute(handle):
        seen.append(handle.goal_id)
        states.append(handle.status)
        handle.succeed()
        return Fibonacci.Result()

    def take(handle):
        states.append(handle.status)
        handle.execute()

    states = []
    server = ActionServer(node, Fibonacci, "count", execute, handle_accepted_callback=take)
    client = ActionClient(node, Fibonacci, "count")
    ids = [None, UUID(uuid=[9] * 16)]
    for goal_id in ids:
        future = client.send_goal_async(order(1), goal_uuid=goal_id)
        rclpy.spin_until_future_complete(node, future)
        rclpy.spin_until_future_complete(node, future.result().get_result_async())
        assert seen[-1] == future.result().goal_id
    assert seen[-1] == ids[-1]
    assert states == [1, 2, 1, 2]
    server.destroy()
    assert not node.get_publishers_info_by_topic("count/_action/status")
    served = node.get_service_names_and_types_by_node(node.get_name(), "/")
    assert not [name for name, _ in served if "_action" in name]


def test_a_goal_is_worked_on_to_its_end_when_its_server_is_destroyed_meanwhile(ros_runtime, node):
    import rclpy
    from action_tutorials_interfaces.action import Fibonacci
    from rclpy.action import ActionClient, ActionServer

    def execute(handle):
        server.destroy()
        handle.publish_feedback(Fibonacci.Feedback(partial_sequence=[1]))
        handle.succeed()
        return Fibonacci.Result(sequence=[1])

    fed, heard = [], []
    server = ActionServer(node, Fibonacci, "count", execute)
    client = ActionClient(node, Fibonacci, "count")
    kind = Fibonacci.Impl.FeedbackMessage
    node.create_subscription(kind, "count/_action/feedback", heard.append, 10)
    future = client.send_goal_async(order(1), feedback_callback=fed.append)
    rclpy.spin_until_future_complete(node, future)
    result = future.result().get_result_async()
    rclpy.spin_until_future_complete(node, result)
    assert result.result().status == 4
    assert len(fed) == 1
    assert not heard
