import pytest


@pytest.fixture
def rclpy(ros_runtime):
    import rclpy

    rclpy.init()
    return rclpy


@pytest.fixture
def camera(rclpy):
    """Create a lifecycle node that records its callbacks, and returns the results in `said`."""
    from rclpy.lifecycle import Node, TransitionCallbackReturn

    class Camera(Node):
        def __init__(self):
            super().__init__("camera")
            self.told = []
            self.said = {}

        def _answer(self, callback, state):
            self.told.append((callback, state.label))
            answer = self.said.get(callback, TransitionCallbackReturn.SUCCESS)
            if isinstance(answer, Exception):
                raise answer
            return answer

        def on_configure(self, state):
            return self._answer("on_configure", state)

        def on_error(self, state):
            return self._answer("on_error", state)

    return Camera()


def state(node):
    return node._state_machine.current_state[1]


def test_a_node_goes_from_state_to_state(camera):
    from rclpy.lifecycle import TransitionCallbackReturn as Return

    for trigger, reached in (
        (camera.trigger_configure, "inactive"),
        (camera.trigger_activate, "active"),
        (camera.trigger_deactivate, "inactive"),
        (camera.trigger_cleanup, "unconfigured"),
        (camera.trigger_configure, "inactive"),
        (camera.trigger_shutdown, "finalized"),
    ):
        assert trigger() is Return.SUCCESS
        assert state(camera) == reached
    assert camera.told == [("on_configure", "unconfigured")] * 2
    with pytest.raises(RuntimeError, match="state 'finalized' has no transition 'configure'"):
        camera.trigger_configure()


@pytest.mark.parametrize(
    ("configured", "recovered", "reached"),
    [
        ("FAILURE", "SUCCESS", "unconfigured"),
        ("ERROR", "SUCCESS", "unconfigured"),
        ("ERROR", "FAILURE", "finalized"),
        ("ERROR", "ERROR", "finalized"),
    ],
)
def test_a_failed_configure_ends_unconfigured_or_finalized(camera, configured, recovered, reached):
    from rclpy.lifecycle import TransitionCallbackReturn

    answer = TransitionCallbackReturn[configured]
    camera.said = {"on_configure": answer, "on_error": TransitionCallbackReturn[recovered]}

    assert camera.trigger_configure() is answer
    assert state(camera) == reached
    assert len(camera.told) == (2 if configured == "ERROR" else 1)


def test_a_callback_that_raises_is_an_error_and_said(camera, ros_runtime):
    camera.said = {"on_configure": OSError("no such device")}

    assert camera.trigger_configure().name == "ERROR"
    assert state(camera) == "unconfigured"
    assert ros_runtime.log("camera") == ["on_configure failed: OSError: no such device"]


def test_a_lifecycle_publisher_sends_while_its_node_is_active(rclpy):
    from rclpy.lifecycle import LifecycleNode, SimpleManagedEntity
    from std_msgs.msg import Int32

    class Lamp(SimpleManagedEntity):
        def __init__(self):
            super().__init__()
            self.shone = []

        @SimpleManagedEntity.when_enabled
        def shine(self, color):
            self.shone.append(color)

        @SimpleManagedEntity.when_enabled(when_not_enabled=lambda: "dark")
        def look(self):
            return "light"

    node, lamp, heard = LifecycleNode("node"), Lamp(), []
    node.add_managed_entity(lamp)
    node.create_subscription(Int32, "numbers", lambda m: heard.append(m.data), 10)
    publisher = node.create_lifecycle_publisher(Int32, "numbers", 10)
    for number, trigger in enumerate(
        (node.trigger_configure, node.trigger_activate, node.trigger_deactivate)
    ):
        trigger()
        publisher.publish(Int32(data=number))
        lamp.shine(number)
        assert lamp.look() == ("light" if number == 1 else "dark")
        assert publisher.is_activated is (number == 1)
    rclpy.spin_once(node, timeout_sec=0)
    rclpy.spin_once(node, timeout_sec=0)

    assert heard == [1]
    assert lamp.shone == [1]
    assert node.destroy_lifecycle_publisher(publisher)
    assert not node.destroy_lifecycle_publisher(publisher)


def test_others_ask_for_the_state_and_change_it(rclpy, camera, ros_runtime):
    from lifecycle_msgs.msg import State, Transition, TransitionEvent
    from lifecycle_msgs.srv import (
        ChangeState,
        GetAvailableStates,
        GetAvailableTransitions,
        GetState,
    )

    manager = rclpy.create_node("manager")
    rclpy.get_global_executor().add_node(camera)
    events = []
    manager.create_subscription(
        TransitionEvent, "/camera/transition_event", lambda e: events.append(e.goal_state.label), 10
    )

    def ask(kind, name, **fields):
        client = manager.create_client(kind, f"/camera/{name}")
        future = client.call_async(kind.Request(**fields))
        rclpy.spin_until_future_complete(manager, future, timeout_sec=5.0)
        return future.result()

    assert ask(GetState, "get_state").current_state == State(id=1, label="unconfigured")
    configure = Transition(id=Transition.TRANSITION_CONFIGURE)
    assert ask(ChangeState, "change_state", transition=configure).success
    assert ask(ChangeState, "change_state", transition=Transition(label="activate")).success
    assert not ask(ChangeState, "change_state", transition=Transition(label="cleanup")).success
    assert ask(GetState, "get_state").current_state.label == "active"
    assert len(ask(GetAvailableStates, "get_available_states").available_states) == 11
    on = ask(GetAvailableTransitions, "get_available_transitions").available_transitions
    assert {(one.transition.label, one.goal_state.label) for one in on} == {
        ("deactivate", "deactivating"),
        ("shutdown", "shuttingdown"),
    }
    graph = ask(GetAvailableTransitions, "get_transition_graph").available_transitions
    numbers = {one.transition.id for one in graph}
    constants = {
        getattr(Transition, name) for name in dir(Transition) if name.startswith("TRANSITION_")
    }
    # Creation, destruction and results of callbacks have numbers too, but are no transitions.
    assert numbers == constants - {0, 8, 97, 98, 99}
    assert events == ["configuring", "inactive", "activating", "active"]
    assert "state 'active' has no transition 'cleanup'" in ros_runtime.log("camera")[-1]


def test_a_node_can_keep_its_state_to_itself(rclpy):
    from rclpy.lifecycle import LifecycleNode

    node = LifecycleNode(
        "node", enable_communication_interface=False, start_parameter_services=False
    )

    assert list(node.services) == []
    assert node.trigger_shutdown().name == "SUCCESS"
    with pytest.raises(TypeError, match="True or False"):
        LifecycleNode("other", enable_communication_interface="yes")
