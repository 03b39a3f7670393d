"""Helpers of launch_testing_ros for launch tests that use topics."""

import random
import string
from collections import deque
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

from tftool.ros.host.locks import StateMonitor
from tftool.ros.host.workers import UserThread
from tftool.ros.rclpy.context import Context
from tftool.ros.rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from tftool.ros.rclpy.node import Node


class MessagePump:
    """Thread that spins a node."""

    def __init__(self, node: Any, context: Any = None) -> None:
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(node)
        self._is_over = False
        self._thread = UserThread(target=self._spin, name="msg_pump_thread")

    def _spin(self) -> None:
        try:
            while not self._is_over:
                self._executor.spin_once(timeout_sec=0.1)
        except ExternalShutdownException:
            return

    def start(self) -> None:
        """Start the thread that spins the node."""
        self._thread.start()

    def stop(self) -> None:
        """Stop spinning the node, and wait until the thread has ended."""
        self._is_over = True
        self._thread.join()


class WaitForTopics:
    """Helper that waits for a message on each of several topics.

    A `with` statement waits at its beginning, and raises RuntimeError at the timeout.
    """

    def __init__(
        self,
        topic_tuples: Iterable[tuple[str, Any]],
        timeout: float = 5.0,
        messages_received_buffer_length: int | None = 10,
    ) -> None:
        """Create a node that subscribes to the topics.

        Wait at most `timeout` seconds; keep at most `messages_received_buffer_length` messages per
        topic, None for all.
        """
        self.topic_tuples, self.timeout = list(topic_tuples), timeout
        self._kept = messages_received_buffer_length
        self._state = StateMonitor()
        self._messages: dict[str, deque[Any]] = {}
        self._context = Context()
        self._context.init()
        letters = "".join(random.choices(string.ascii_uppercase + string.digits, k=10))
        self._node = Node(f"_test_node_{letters}", context=self._context)
        self._pump = MessagePump(self._node, self._context)
        self._pump.start()

    def wait(self) -> bool:
        """Wait for a message on each topic; return False at the timeout."""
        for topic, kind in self.topic_tuples:
            if topic not in self._messages:
                kept = self._messages[topic] = deque(maxlen=self._kept)
                self._node.create_subscription(kind, topic, partial(self._take, kept), 10)
            self._messages[topic].clear()
        return self._state.wait(lambda: all(self._messages.values()), self.timeout)

    def _take(self, kept: deque[Any], message: Any) -> None:
        with self._state.changing():
            kept.append(message)

    def shutdown(self) -> None:
        """Stop spinning the helper's node, and destroy the node."""
        self._pump.stop()
        self._node.destroy_node()
        self._context.try_shutdown()

    def topics_received(self) -> set[str]:
        """Return the topics on which a message has arrived."""
        return {topic for topic, messages in self._messages.items() if messages}

    def topics_not_received(self) -> set[str]:
        """Return the topics on which no message has arrived."""
        return {topic for topic, _ in self.topic_tuples} - self.topics_received()

    def received_messages(self, topic_name: str) -> list[Any]:
        """Return the stored messages of a topic, oldest first; `__init__` limits their number.

        Raises:
            KeyError: If the helper does not wait for this topic.
        """
        if topic_name not in self._messages:
            raise KeyError(f"No messages received for topic: {topic_name}")
        return list(self._messages[topic_name])

    def __enter__(self) -> "WaitForTopics":
        if not self.wait():
            missing = self.topics_not_received()
            self.shutdown()
            raise RuntimeError("Did not receive messages on these topics: ", missing)
        return self

    def __exit__(self, *error: object) -> None:
        self.shutdown()


class DataRepublisher:
    """Helper that changes each message on a topic and publishes the result on another topic."""

    def __init__(
        self,
        node: Any,
        listen_topic: str,
        publish_topic: str,
        msg_type: Any,
        transform_fn: Callable[[Any], Any],
    ) -> None:
        """Create the subscription and the publisher.

        `transform_fn` returns the changed message, or None to publish nothing.
        """
        self._node, self._change = node, transform_fn
        self._received = 0
        self._republished: list[Any] = []
        self._publisher = node.create_publisher(msg_type, publish_topic, 10)
        self._subscription = node.create_subscription(msg_type, listen_topic, self._take, 10)

    def _take(self, message: Any) -> None:
        self._received += 1
        if changed := self._change(message):
            self._republished.append(message)
            self._publisher.publish(changed)

    def shutdown(self) -> None:
        """Destroy the subscription and the publisher."""
        self._node.destroy_subscription(self._subscription)
        self._node.destroy_publisher(self._publisher)

    def get_num_received(self) -> int:
        """Return the number of received messages."""
        return self._received

    def get_num_republished(self) -> int:
        """Return the number of published messages."""
        return len(self._republished)

    def get_republished(self) -> list[Any]:
        """Return the received messages whose changed copies were published."""
        return self._republished
