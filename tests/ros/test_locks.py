"""Tests of locks, conditions, semaphores and queues of users' programs, on simulated time."""

import threading

import pytest

from tests.patience import PATIENCE

PROGRAM = """
import queue
import threading
import time

import rclpy

rclpy.init()
node = rclpy.create_node('probe_locks')
begin = time.monotonic()


def say(*words):
    node.get_logger().info(f"{time.monotonic() - begin:g} " + " ".join(map(str, words)))


def other(work):
    thread = threading.Thread(target=work)
    thread.start()
    return thread

"""


def told(ros_runtime, tmp_path, body):
    """Return the log of a program that runs for twenty simulated seconds."""
    file = tmp_path / "locking.py"
    file.write_text(PROGRAM + body)
    program = ros_runtime.start(file)
    ros_runtime.sleep(20)
    assert program.status == 0, ros_runtime.log(program.name)
    return ros_runtime.log("probe_locks")


@pytest.mark.parametrize("kind", ["Lock", "RLock", "Semaphore", "BoundedSemaphore", "Condition"])
def test_a_lock_held_over_a_sleep_holds_up_only_the_thread_that_wants_it(
    ros_runtime, tmp_path, kind
):
    body = f"""
lock = threading.{kind}()


def hold():
    with lock:
        time.sleep(3)
    say('released')


thread = other(hold)
time.sleep(1)
say(lock.acquire(timeout=0.5), lock.acquire(blocking=False))
with lock:
    say('taken')
thread.join()
"""
    lines = told(ros_runtime, tmp_path, body)

    assert lines[0] == "1.5 False False"
    assert sorted(lines[1:]) == ["3 released", "3 taken"]


def test_a_queue_waits_in_simulated_time(ros_runtime, tmp_path):
    body = """
box = queue.Queue(maxsize=1)
try:
    box.get(timeout=5)
except queue.Empty:
    say('empty')


def feed():
    for number in range(3):
        time.sleep(1)
        box.put(number)


thread = other(feed)
for _ in range(3):
    say(box.get(), box.task_done())
box.join()
simple = queue.SimpleQueue()
other(lambda: (time.sleep(2), simple.put('late')))
say(simple.get())
"""
    assert told(ros_runtime, tmp_path, body) == [
        "5 empty",
        "6 0 None",
        "7 1 None",
        "8 2 None",
        "10 late",
    ]


def test_a_condition_wakes_as_many_as_are_notified(ros_runtime, tmp_path):
    body = """
ready = threading.Condition()
items = []


def take(name):
    with ready:
        ready.wait_for(lambda: items)
        say(name, items.pop())


threads = [other(lambda name=name: take(name)) for name in ('one', 'two')]
with ready:
    say(ready.wait(timeout=2))
    items.append('a')
    ready.notify()
time.sleep(1)
with ready:
    items.append('b')
    ready.notify_all()
for thread in threads:
    thread.join()
try:
    ready.notify()
except RuntimeError as error:
    say(error)
"""
    lines = told(ros_runtime, tmp_path, body)

    assert lines == ["2 False", "2 one a", "3 two b", "3 cannot notify on un-acquired lock"]


def test_threads_meet_at_a_barrier_and_join_has_a_time_limit(ros_runtime, tmp_path):
    body = """
meeting = threading.Barrier(2)


def come():
    time.sleep(4)
    meeting.wait()


thread = other(come)
thread.join(timeout=1.5)
say(thread.is_alive())
meeting.wait()
say('met')
thread.join()
say(thread.is_alive())
"""
    assert told(ros_runtime, tmp_path, body) == ["1.5 True", "4 met", "4 False"]


def test_locks_refuse_the_same_wrong_calls_as_pythons_own_locks():
    from tftool.ros.host import locks

    for ours, real in (
        (locks.UserLock(), threading.Lock()),
        (locks.UserRLock(), threading.RLock()),
        (locks.UserBoundedSemaphore(1), threading.BoundedSemaphore(1)),
    ):
        for lock in (ours, real):
            with pytest.raises((RuntimeError, ValueError)):
                lock.release()
            with pytest.raises(ValueError, match="timeout for"):
                lock.acquire(False, 1.0)
            assert lock.acquire()
    with pytest.raises(ValueError, match="initial value"):
        locks.UserSemaphore(-1)


def test_threads_of_no_program_share_a_lock_in_real_time():
    from tftool.ros.host.locks import UserCondition, UserEvent

    box, ready, seen = [], UserCondition(), UserEvent()

    def feed():
        with ready:
            box.append(1)
            ready.notify()
        seen.set()

    thread = threading.Thread(target=feed)
    with ready:
        thread.start()
        assert ready.wait_for(lambda: box, timeout=PATIENCE) == [1]
    assert seen.wait(PATIENCE)
    thread.join()


def test_two_programs_that_sleep_while_they_are_imported_go_on(ros_runtime, tmp_path):
    (tmp_path / "slow_helper.py").write_text("import time\ntime.sleep(2)\nREADY = True\n")
    for name in ("first", "second"):
        (tmp_path / f"{name}.py").write_text(
            "import slow_helper\nimport rclpy\nrclpy.init()\n"
            f"rclpy.create_node('{name}_node').get_logger().info(str(slow_helper.READY))\n"
        )
    programs = [ros_runtime.start(tmp_path / f"{name}.py") for name in ("first", "second")]
    ros_runtime.sleep(5)

    assert [one.status for one in programs] == [0, 0]
    assert ros_runtime.log("first_node") == ros_runtime.log("second_node") == ["True"]


def test_two_packages_that_sleep_while_they_are_imported_go_on(ros_runtime, tmp_path):
    from tftool.ros.host import user_code

    bodies = []
    for name in ("one", "two"):
        package = tmp_path / name / name
        package.mkdir(parents=True)
        (package / "__init__.py").touch()
        (package / "talker.py").write_text(
            "import time\ntime.sleep(1)\nimport rclpy\n"
            f"def main():\n    rclpy.init()\n    rclpy.create_node('{name}_talker')\n"
        )
        root = tmp_path / name
        bodies.append(user_code.entry_point_body(f"{name}.talker", "main", root=root))
    programs = [ros_runtime.start(body) for body in bodies]
    ros_runtime.sleep(5)

    assert [one.status for one in programs] == [0, 0]
