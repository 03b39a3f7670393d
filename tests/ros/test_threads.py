"""Tests of threads in users' programs."""

import sys

import pytest

from tftool.app.main import main


def test_a_nodes_own_thread_takes_turns_too(ros_runtime, tmp_path):
    file = tmp_path / "threaded.py"
    file.write_text(
        """
import threading
import time

import rclpy
from std_msgs.msg import Float64

rclpy.init()
node = rclpy.create_node('threaded')
thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
thread.start()
out = node.create_publisher(Float64, 'times', 10)
begin = time.time()
for _ in range(3):
    time.sleep(0.5)
    out.publish(Float64(data=time.time() - begin))
node.create_timer(0.25, rclpy.shutdown)
thread.join()
out.publish(Float64(data=time.monotonic()))
assert not thread.is_alive()
"""
    )
    from std_msgs.msg import Float64

    heard = []
    ros_runtime.world.topic("times", Float64).subscribe(lambda m: heard.append(m.data))
    program = ros_runtime.start(file)
    ros_runtime.sleep(5)

    assert heard[:3] == [0.5, 1.0, 1.5]
    assert heard[3] == pytest.approx(1.75, abs=0.002)
    assert program.status == 0


def test_an_exception_in_a_thread_is_logged_and_ends_only_that_thread(ros_runtime, tmp_path):
    file = tmp_path / "threaded.py"
    file.write_text(
        "import threading\n"
        "def work():\n"
        "    raise ValueError('too far')\n"
        "thread = threading.Thread(target=work, name='worker')\n"
        "thread.start()\n"
        "thread.join()\n"
        "import rclpy\n"
        "rclpy.init()\n"
    )
    program = ros_runtime.start(file)
    ros_runtime.sleep(1)

    (said,) = ros_runtime.log(program.name)
    assert said.startswith("thread 'worker' failed: ValueError: too far\n")
    assert "threaded.py:3, in work: raise ValueError('too far')" in said
    assert program.status == 0


def test_an_event_lets_a_callback_wait_for_an_answer_in_another_thread(ros_runtime, tmp_path):
    file = tmp_path / "waiter.py"
    file.write_text(
        """
from threading import Event

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node('waiter')
group = ReentrantCallbackGroup()


def answer(request, response):
    response.message = 'here'
    return response


node.create_service(Trigger, 'go', answer, callback_group=group)
client = node.create_client(Trigger, 'go', callback_group=group)


def ask():
    timer.cancel()
    event = Event()
    future = client.call_async(Trigger.Request())
    future.add_done_callback(lambda _: event.set())
    assert not event.is_set()
    event.wait(5.0)
    node.get_logger().info(future.result().message)
    event.clear()
    node.get_logger().info(str(event.wait(timeout=1.0)))


timer = node.create_timer(0.5, ask, callback_group=group)
executor = MultiThreadedExecutor()
executor.add_node(node)
executor.spin()
"""
    )
    ros_runtime.start(file)
    ros_runtime.sleep(3)

    assert ros_runtime.log("waiter") == ["here", "False"]


def test_a_pool_may_ask_and_log_but_not_wait_on_simulated_time(node, ros_runtime):
    from concurrent.futures import ThreadPoolExecutor

    from tftool.base.errors import TftoolError

    with ThreadPoolExecutor() as pool:
        assert pool.submit(node.get_topic_names_and_types).result()
        pool.submit(node.get_logger().info, "from the pool").result()
        with pytest.raises(TftoolError, match="thread of a pool cannot wait"):
            pool.submit(node.wait_for_node, "probe", 1.0).result()

    assert ros_runtime.log("probe") == ["from the pool"]


POOLS = """
import concurrent.futures
import threading
import time
from concurrent import futures
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, as_completed, wait

import rclpy


def work(seconds):
    time.sleep(seconds)
    return seconds


rclpy.init()
node = rclpy.create_node('pools')
begin = time.time()
say = lambda text: node.get_logger().info(f'{time.time() - begin:.1f} {text}')
assert futures.ThreadPoolExecutor is concurrent.futures.ThreadPoolExecutor is ThreadPoolExecutor
with ThreadPoolExecutor(max_workers=2) as pool:
    begun = [pool.submit(work, seconds) for seconds in (2, 1, 1.5)]
    say(len(wait(begun, return_when=FIRST_COMPLETED).done))
    for future in as_completed(begun, timeout=9):
        say(future.result())
    late = pool.submit(work, 3)
    try:
        late.result(timeout=1)
    except TimeoutError:
        say('late')
    event = threading.Event()
    waits = pool.submit(event.wait)
    event.set()
    say(waits.result())
    failed = pool.submit(int, 'x')
    say(wait([failed, late], return_when=futures.FIRST_EXCEPTION).not_done == {late})
    say(list(pool.map(work, [0.5, 0.5])))
say('closed')
try:
    pool.submit(work, 1)
except RuntimeError as error:
    say(error)
"""


def test_the_threads_of_a_programs_pool_wait_on_the_clock_of_the_run(ros_runtime, tmp_path):
    file = tmp_path / "pools.py"
    file.write_text(POOLS)
    program = ros_runtime.start(file)
    ros_runtime.sleep(10)

    assert program.status == 0
    # One of two threads works for 2 and then, on the late job, 3 s; the other does the rest.
    assert ros_runtime.log("pools") == [
        "1.0 1",
        "1.0 1",
        "2.0 2",
        "2.5 1.5",
        "3.5 late",
        "3.5 True",
        "3.5 True",
        "4.5 [0.5, 0.5]",
        "5.5 closed",
        "5.5 cannot schedule new futures after shutdown",
    ]


def test_a_timer_of_threading_waits_in_the_worlds_time(ros_runtime, tmp_path):
    file = tmp_path / "later.py"
    file.write_text(
        """
import threading

import rclpy

rclpy.init()
node = rclpy.create_node('later')
say = node.get_logger().info
threading.Timer(2.0, say, args=['two'], kwargs={}).start()
given_up = threading.Timer(1.0, say, args=('one',))
given_up.start()
given_up.cancel()
given_up.join()
say(f'begun {given_up.finished.is_set()}')
rclpy.spin(node)
"""
    )
    ros_runtime.start(file)
    ros_runtime.sleep(1.9)
    assert ros_runtime.log("later") == ["begun True"]
    ros_runtime.sleep(0.2)
    assert ros_runtime.log("later") == ["begun True", "two"]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows cannot copy a process")
def test_a_child_of_multiprocessing_computes_ends_at_a_signal_and_may_not_use_rclpy(
    tmp_path, capfd
):
    file = tmp_path / "pool.py"
    file.write_text(
        "import multiprocessing, time\n"
        "import rclpy\n"
        "fork = multiprocessing.get_context('fork')\n"
        "def main():\n"
        "    rclpy.init()\n"
        "    with fork.Pool(2) as pool:\n"
        "        print(pool.map(abs, [-1, -2]))\n"
        "    child = fork.Process(target=time.sleep, args=(60,))\n"
        "    child.start()\n"
        "    child.terminate()\n"
        "    child.join()\n"
        "    print('ended by signal', -child.exitcode)\n"
        "    child = fork.Process(target=rclpy.create_node, args=('n',))\n"
        "    child.start()\n"
        "    child.join()\n"
        "    print('status', child.exitcode)\n"
    )
    assert main(["run", "--simulated", "--for", "3", str(file)]) == 0
    out, err = capfd.readouterr()

    assert out.splitlines() == ["[1, 2]", "ended by signal 15", "status 1"]
    assert "a process that multiprocessing has started cannot use rclpy in tftool" in err


PROCESSES = """
import time
from multiprocessing import Process

import rclpy
from std_msgs.msg import Int32


def talk(number):
    rclpy.init()
    node = rclpy.create_node(f'talker{number}')
    out = node.create_publisher(Int32, 'numbers', 10)
    node.create_timer(1.0, lambda: out.publish(Int32(data=number)))
    rclpy.spin(node)


def fail():
    rclpy.init()
    raise ValueError('too far')


class Listener(Process):
    def run(self):
        rclpy.init()
        node = rclpy.create_node('listener')
        say = node.get_logger().info
        node.create_subscription(Int32, 'numbers', lambda message: say(str(message.data)), 10)
        rclpy.spin(node)


if __name__ == '__main__':
    first, second = (Process(target=talk, args=(number,)) for number in (1, 2))
    for one in (Listener(), first, second):
        one.start()
    failed = Process(target=fail, name='fails')
    failed.start()
    failed.join()
    assert (failed.exitcode, first.is_alive(), first.exitcode) == (1, True, None)
    time.sleep(1.5)
    second.terminate()
    second.join()
    assert not second.is_alive()
    first.join(timeout=1.0)
    assert first.is_alive()
    first.join()
"""


def test_processes_with_nodes_are_programs_of_the_same_world(tmp_path, capfd):
    file = tmp_path / "processes.py"
    file.write_text(PROCESSES)

    assert main(["run", "--simulated", "--for", "3.5", str(file)]) == 0
    said = capfd.readouterr().err

    heard = [line.partition("[listener]: ")[2] for line in said.splitlines() if "listener" in line]
    # The second talker ends after 1.5 s.
    assert sorted(heard[:2]) + heard[2:] == ["1", "2", "1", "1"]
    assert "process 'fails' failed: ValueError: too far" in said
    assert "rclpy.init()" not in said
