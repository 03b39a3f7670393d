"""Tests of services and their clients."""

import pytest

from tests.ros.spinning import spin


def test_a_service_answers_a_client(node):
    import rclpy
    from example_interfaces.srv import AddTwoInts

    def add(request, response):
        response.sum = request.a + request.b
        return response

    service = node.create_service(AddTwoInts, "add_two_ints", add)
    asker = rclpy.create_node("asker")
    client = asker.create_client(AddTwoInts, "add_two_ints")
    assert client.wait_for_service(timeout_sec=1.0)
    future = client.call_async(AddTwoInts.Request(a=2, b=3))
    executor = rclpy.get_global_executor()
    executor.add_node(node)
    executor.add_node(asker)
    executor.spin_until_future_complete(future, timeout_sec=1.0)

    assert future.result().sum == 5
    node.destroy_service(service)
    assert not client.service_is_ready()
    assert not client.wait_for_service(timeout_sec=0.5)


def test_requests_wait_for_a_node_that_does_not_spin_up_to_a_bound(node):
    import rclpy
    from std_srvs.srv import Trigger

    node.create_service(Trigger, "busy", lambda request, response: response)
    asker = rclpy.create_node("asker")
    client = asker.create_client(Trigger, "busy")
    futures = [client.call_async(Trigger.Request()) for _ in range(1003)]
    executor = rclpy.get_global_executor()
    executor.add_node(asker)
    executor.spin_until_future_complete(futures[-1], timeout_sec=1.0)

    refused = [future for future in futures if future.done()]
    assert refused == futures[-3:]
    with pytest.raises(
        Exception, match=r"'busy' has 1000 requests waiting.*check that the node spins"
    ):
        refused[0].result()


def test_goals_wait_for_a_node_that_does_not_spin_up_to_a_bound(node):
    import rclpy
    from example_interfaces.action import Fibonacci
    from rclpy.action import ActionClient, ActionServer

    server = ActionServer(node, Fibonacci, "fibonacci", lambda handle: Fibonacci.Result())
    asker = rclpy.create_node("asker")
    client = ActionClient(asker, Fibonacci, "fibonacci")
    futures = [client.send_goal_async(Fibonacci.Goal(order=1)) for _ in range(1003)]
    executor = rclpy.get_global_executor()
    executor.add_node(asker)
    executor.spin_until_future_complete(futures[-1], timeout_sec=1.0)

    refused = [future for future in futures if future.done()]
    assert refused == futures[-3:]
    assert not refused[0].result().accepted
    server.destroy()


def test_a_request_nobody_serves_stays_unanswered(node):
    import rclpy
    from std_srvs.srv import Trigger

    future = node.create_client(Trigger, "nobody").call_async(Trigger.Request())
    rclpy.spin_until_future_complete(node, future, timeout_sec=1.0)

    assert not future.done()
    with pytest.raises(TypeError, match="Expected"):
        node.create_client(Trigger, "nobody").call_async("now")


def test_waiting_for_an_answer_inside_a_callback_works(node):
    import rclpy
    from std_srvs.srv import SetBool

    other = rclpy.create_node("server")

    async def answer(request, response):
        response.success = request.data
        return response

    other.create_service(SetBool, "switch", answer)
    client = node.create_client(SetBool, "switch")
    answers = []

    def ask():
        future = client.call_async(SetBool.Request(data=True))
        rclpy.spin_until_future_complete(node, future, timeout_sec=1.0)
        answers.append(future.result().success)
        answers.append(client.call(SetBool.Request(data=False), timeout_sec=1.0).success)

    timer = node.create_timer(1.0, ask)
    executor = rclpy.get_global_executor()
    executor.add_node(other)
    executor.add_node(node)
    executor.spin_once(timeout_sec=2.0)
    timer.cancel()

    assert answers == [True, False]


def test_a_wrong_answer_of_a_service_is_named(node):
    import rclpy
    from std_srvs.srv import Trigger

    node.create_service(Trigger, "go", lambda request, response: None)
    client = node.create_client(Trigger, "go")
    future = client.call_async(Trigger.Request())

    with pytest.raises(TypeError, match=r"service 'go' must return a Trigger\.Response, not None"):
        rclpy.spin_until_future_complete(node, future)


def test_our_own_nodes_may_ask_a_users_service(node, ros_runtime):
    import threading  # noqa: F401

    from turtlesim.srv import Spawn as RosSpawn

    from tftool.messages.classes import build
    from tftool.messages.turtle_messages import Spawn

    def spawn(request, response):
        response.name = f"{request.name} at {request.x}"
        return response

    node.create_service(RosSpawn, "spawn", spawn)
    answers = []

    async def ask():
        answers.append(
            await ros_runtime.world.call("spawn", build(Spawn.Request, 1.5, 2.0, name="me"))
        )

    import asyncio

    ros_runtime.ask(lambda: [asyncio.get_running_loop().create_task(ask())])
    spin(node, 0.1)

    assert answers[0].name == "me at 1.5"


def test_a_service_that_goes_answers_with_a_sentence(node, ros_runtime):
    import rclpy
    from std_srvs.srv import Trigger

    service = node.create_service(Trigger, "go", lambda request, response: response)
    asker = rclpy.create_node("asker")
    client = asker.create_client(Trigger, "go")
    future = client.call_async(Trigger.Request())
    ros_runtime.sleep(0.1)
    service.destroy()
    rclpy.spin_until_future_complete(asker, future, timeout_sec=1.0)

    with pytest.raises(Exception, match="the node that served 'go' has ended"):
        future.result()
    other = client.call_async(Trigger.Request())
    client.remove_pending_request(other)
    assert other.cancelled()


def test_the_simulators_services_take_ros_requests(node, ros_runtime):
    from std_srvs.srv import Empty
    from turtlesim.srv import Kill, SetPen, Spawn, TeleportAbsolute, TeleportRelative

    from tftool.world.nodes.turtlesim import Turtlesim

    ros_runtime.ask(lambda: Turtlesim(ros_runtime.world))

    def ask(kind, service, **fields):
        client = node.create_client(kind, service)
        assert client.wait_for_service(timeout_sec=1.0)
        return client.call(kind.Request(**fields), timeout_sec=1.0)

    assert ask(Spawn, "spawn", x=1.0, y=2.0).name == "turtle2"
    assert ask(TeleportAbsolute, "turtle2/teleport_absolute", x=3.0, y=4.0) is not None
    assert ask(TeleportRelative, "turtle2/teleport_relative", linear=1.0) is not None
    assert ask(SetPen, "turtle2/set_pen", r=255, width=5) is not None
    ros_runtime.sleep(0.1)
    turtle = ros_runtime.world.node("turtlesim").turtles["turtle2"]
    assert tuple(turtle.place)[:2] == pytest.approx((4.0, 4.0))
    assert ask(Kill, "kill", name="turtle2") is not None
    assert ask(Empty, "clear") is not None
    assert ask(Empty, "reset") is not None
    assert list(ros_runtime.world.node("turtlesim").turtles) == ["turtle1"]
