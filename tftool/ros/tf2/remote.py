"""Client and server of tf2_ros's action for transform lookups in another node's buffer."""

from typing import Any

from tftool.base.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from tftool.messages.classes import INTERFACES
from tftool.ros.host.values import time_message
from tftool.ros.rclpy.action_client import ActionClient
from tftool.ros.rclpy.action_server import ActionServer
from tftool.ros.rclpy.executors import wait_for
from tftool.ros.rclpy.futures import Future
from tftool.ros.rclpy.node_state import state_of
from tftool.ros.rclpy.time import Duration
from tftool.ros.tf2.buffer import (
    Buffer,
    BufferInterface,
    LookupRequest,
    full_request,
    lookup_request,
    nanoseconds_of,
)

_PADDING = Duration(seconds=2.0)

_NUMBERS: tuple[tuple[type[TransformException], int], ...] = (
    (LookupException, 1),
    (ConnectivityException, 2),
    (ExtrapolationException, 3),
    (InvalidArgumentException, 4),
    (TimeoutException, 5),
    (TransformException, 6),
)
"""Error number in a TF2Error for each exception class, subclasses before their bases."""


def _action() -> Any:
    return INTERFACES.find("tf2_msgs", "action", "LookupTransform")


class BufferClient(BufferInterface):
    """Client that looks up transforms in another node's buffer, with the methods of `Buffer`."""

    def __init__(
        self, node: Any, ns: str, check_frequency: float = 10.0, timeout_padding: Any = _PADDING
    ) -> None:
        """Create a client for the buffer of another node.

        `timeout_padding`, a Duration or seconds, is added to the timeout of each lookup.
        `check_frequency` is ignored, because tftool does not poll for the result as ROS 2 does.
        """
        super().__init__()
        self.node = node
        self.action_client = ActionClient(node, _action(), ns)
        self.check_frequency = check_frequency
        self.timeout_padding = timeout_padding

    def destroy(self) -> None:
        """Destroy the action client."""
        self.action_client.destroy()

    def _look_up(self, request: LookupRequest, timeout: Any) -> Any:
        if not self.action_client.server_is_ready():
            raise TimeoutException("The BufferServer is not ready.")
        goal = _action().Goal(
            timeout=Duration(nanoseconds=nanoseconds_of(timeout)).to_msg(),
            target_frame=request.target,
            target_time=time_message(request.target_time),
            source_frame=request.source,
            source_time=time_message(request.time),
            fixed_frame=request.fixed or "",
            advanced=request.fixed is not None,
        )
        padding = self.timeout_padding
        extra = nanoseconds_of(padding) / 1e9 if isinstance(padding, Duration) else float(padding)
        # The response needs some time to arrive, even if no padding is added.
        limit = nanoseconds_of(timeout) / 1e9 + max(extra, 0.1)
        state = state_of(self.node)
        sent = self.action_client.send_goal_async(goal)
        wait_for(state, sent, limit)
        if not sent.done() or not sent.result().accepted:
            raise TimeoutException("The BufferServer did not take the goal in time.")
        answer = sent.result().get_result_async()
        wait_for(state, answer, limit)
        if not answer.done():
            raise TimeoutException("The BufferServer did not answer in time.")
        result = answer.result().result
        for kind, number in _NUMBERS:
            if result.error.error == number:
                raise kind(result.error.error_string)
        return result.transform


class BufferServer:
    """Server that lets `BufferClient`s of other nodes look up transforms in a buffer."""

    def __init__(
        self, buffer: Buffer, node: Any, ns: str = "tf2_buffer_server", check_period: Any = None
    ) -> None:
        """Start the action server.

        `check_period` is ignored, because tftool does not poll for transforms as ROS 2 does.
        """
        self.buffer = buffer
        self.node = node
        self._server = ActionServer(node, _action(), ns, self._answer)

    async def _answer(self, goal: Any) -> Any:
        sent = goal.request
        request = lookup_request(sent.target_frame, sent.source_frame, sent.source_time)
        if sent.advanced:
            request = full_request(
                *(sent.target_frame, sent.target_time),
                *(sent.source_frame, sent.source_time, sent.fixed_frame),
            )
        found = self.buffer.promise(request)
        await self._wait_for(found, Duration.from_msg(sent.timeout))
        result = _action().Result()
        try:
            result.transform = self.buffer.answer(request)
        except TransformException as refused:
            result.error.error = next(
                number for kind, number in _NUMBERS if isinstance(refused, kind)
            )
            result.error.error_string = str(refused)
            goal.abort()
        else:
            goal.succeed()
        finally:
            found.cancel()
        return result

    async def _wait_for(self, future: Future, limit: Duration) -> None:
        """Wait until `future` is done, at most for the time `limit`."""
        if future.done() or limit.nanoseconds <= 0:
            return
        over = Future()

        def end(*_: object) -> None:
            if not over.done():
                over.set_result(None)

        timer = self.node.create_timer(limit.nanoseconds / 1e9, end)
        future.add_done_callback(end)
        try:
            await over
        finally:
            self.node.destroy_timer(timer)

    def destroy(self) -> None:
        """Destroy the action server."""
        self._server.destroy()
