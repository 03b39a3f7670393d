"""Futures of rclpy, and tasks, which are the futures of coroutines run by an executor."""

import asyncio
import contextlib
import inspect
import threading
from collections.abc import Callable, Coroutine, Generator
from typing import Any


class _Stepping(threading.local):
    """State of one thread: the asyncio task inside which an executor runs a step of a `Task`.

    Attributes:
        asyncio_task: The asyncio task; None if no executor runs a step, or the executor runs
            outside of asyncio.
    """

    asyncio_task: "asyncio.Task[Any] | None" = None


_STEPPING = _Stepping()


def _asyncio_task() -> "asyncio.Task[Any] | None":
    try:
        return asyncio.current_task()
    except RuntimeError:
        return None


class Future:
    """Placeholder for a result that is set later."""

    def __init__(self, *, executor: Any = None) -> None:
        self._done = False
        self._cancelled = False
        self._result: Any = None
        self._exception: BaseException | None = None
        self._asked = False
        self._callbacks: list[Callable[[Any], object]] = []
        self._watchers: list[Callable[[Any], object]] = []
        self._executor = executor
        # A result may be set in another thread. The lock is never held while a callback runs.
        self._mutex = threading.Lock()

    def __await__(self) -> Generator[Any, None, Any]:
        task = _asyncio_task()
        # If tasks of asyncio and of an executor are nested, the innermost one decides how to wait.
        in_asyncio = task is not None and task is not _STEPPING.asyncio_task
        while not self._done and not self._cancelled:
            if in_asyncio:
                yield from self._wait_in_asyncio(asyncio.get_running_loop())
            else:
                yield self
        return self.result()

    def _wait_in_asyncio(self, loop: asyncio.AbstractEventLoop) -> Generator[Any, None, None]:
        """Wait for this future in a task of asyncio, without blocking asyncio's event loop."""
        over = loop.create_future()

        def settle() -> None:
            if not over.done():
                over.set_result(None)

        def tell(_: Any) -> None:
            with contextlib.suppress(RuntimeError):  # The loop is closed.
                loop.call_soon_threadsafe(settle)

        self.watch(tell)
        yield from over

    def done(self) -> bool:
        """Return whether the future has a result or an exception."""
        return self._done

    def cancelled(self) -> bool:
        """Return whether the future was cancelled."""
        return self._cancelled

    def cancel(self) -> None:
        """Cancel the future; do nothing if it is done."""
        with self._mutex:
            if self._done:
                return
            self._cancelled = True
        self._tell()

    def result(self) -> Any:
        """Return the result; None if the future is not done.

        Raises:
            BaseException: The exception given to `set_exception`, if that method was called.
        """
        if self._exception is not None:
            self._asked = True
            raise self._exception
        return self._result

    def exception(self) -> BaseException | None:
        """Return the exception given to `set_exception`; None if that method was not called."""
        self._asked = True
        return self._exception

    def set_result(self, result: Any) -> None:
        """Set the result, which completes the future."""
        with self._mutex:
            self._result = result
            self._done = True
            self._cancelled = False
        self._tell()

    def set_exception(self, exception: BaseException) -> None:
        """Complete the future with an exception, which the method `result` then raises."""
        with self._mutex:
            self._exception = exception
            self._asked = False
            self._done = True
            self._cancelled = False
        self._tell()

    def add_done_callback(self, callback: Callable[[Any], object]) -> None:
        """Call `callback` with this future when the future is done, or now if it is done already.

        As in ROS 2, the future's executor calls `callback` as a task. A future without an executor
        calls `callback` in the thread that completes the future.
        """
        self._add(callback, self._callbacks, self._call)

    def watch(self, callback: Callable[[Any], object]) -> None:
        """Call `callback` with this future when the future is done.

        Unlike with `add_done_callback`, the thread that completes the future always calls
        `callback`.
        """
        self._add(callback, self._watchers, lambda watcher: watcher(self))

    def _add(
        self,
        callback: Callable[[Any], object],
        waiting: list[Callable[[Any], object]],
        call: Callable[[Callable[[Any], object]], object],
    ) -> None:
        with self._mutex:
            is_over = self._done or self._cancelled
            if not is_over:
                waiting.append(callback)
        if is_over:
            call(callback)

    def remove_done_callback(self, callback: Callable[[Any], object]) -> bool:
        """Remove a callback added by `add_done_callback`; return whether the callback was found."""
        with self._mutex:
            found = callback in self._callbacks
            self._callbacks[:] = [one for one in self._callbacks if one != callback]
        return found

    def _tell(self) -> None:
        with self._mutex:
            watchers, callbacks = self._watchers[:], self._callbacks[:]
            self._watchers.clear()
            self._callbacks.clear()
        for watcher in watchers:
            watcher(self)
        for callback in callbacks:
            self._call(callback)

    def _call(self, callback: Callable[[Any], object]) -> None:
        if self._executor is not None:
            self._executor.create_task(callback, self)
        elif inspect.iscoroutine(callback(self)):
            raise TypeError("a done-callback of a future without an executor cannot be a coroutine")

    def set_executor(self, executor: Any) -> None:
        """Set the executor that runs done callbacks; None to run them in the completing thread."""
        self._executor = executor


class Task(Future):
    """Future of a callback or coroutine that an executor runs."""

    def __init__(
        self,
        handler: Callable[..., Any] | Coroutine[Any, Any, Any],
        args: Any = None,
        kwargs: Any = None,
        executor: Any = None,
    ) -> None:
        super().__init__(executor=executor)
        self._is_stepping = False
        if inspect.iscoroutine(handler):
            self._coroutine: Coroutine[Any, Any, Any] | None = handler
            self._handler: Callable[[], Any] | None = None
        else:
            function: Any = handler
            self._coroutine = None
            self._handler = lambda: function(*(args or ()), **(kwargs or {}))

    def __call__(self) -> Any:
        """Run the task until it has to wait for another future, or ends.

        Returns:
            The object that the task waits for; None if the task has ended.
        """
        if self._done or self._cancelled:
            return None
        asyncio_task, _STEPPING.asyncio_task = _STEPPING.asyncio_task, _asyncio_task()
        self._is_stepping = True
        try:
            if self._coroutine is None and self._handler is not None:
                value = self._handler()
                if not inspect.iscoroutine(value):
                    self.set_result(value)
                    return None
                self._coroutine = value
            if self._coroutine is not None:
                return self._coroutine.send(None)
        except StopIteration as ended:
            self.set_result(ended.value)
        except Exception as error:
            self.set_exception(error)
        finally:
            self._is_stepping = False
            _STEPPING.asyncio_task = asyncio_task
        return None

    def executing(self) -> bool:
        """Return whether an executor is running a step of this task now."""
        return self._is_stepping

    def cancel(self) -> None:
        """Cancel the task, and close the coroutine."""
        if self._coroutine is not None and not self._done:
            self._coroutine.close()
        super().cancel()
