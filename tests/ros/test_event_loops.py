"""Tests of asyncio in users' programs."""

import pytest

from tftool.app.main import main

LOOP = """
import asyncio
import time

import rclpy
from std_msgs.msg import Float64

rclpy.init()
node = rclpy.create_node('waits')
out = node.create_publisher(Float64, 'times', 10)
begin = time.time()


def tell():
    out.publish(Float64(data=time.time() - begin))


async def spinning():
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0)
        await asyncio.sleep(0.01)


async def work():
    spinner = asyncio.get_running_loop().create_task(spinning())
    node.create_timer(1.0, tell)
    await asyncio.gather(asyncio.sleep(0.5), asyncio.sleep(1.25))
    tell()
    spinner.cancel()

"""
LEGACY = "asyncio.get_event_loop().run_until_complete(work())\n"
MODERN = "asyncio.run(work())\n"
OWN = "loop = asyncio.new_event_loop()\nloop.run_until_complete(work())\nloop.close()\n"


@pytest.mark.parametrize("start", [LEGACY, MODERN, OWN], ids=["get_event_loop", "run", "new"])
def test_coroutines_wait_in_the_worlds_time_and_let_it_go_on(ros_runtime, tmp_path, start):
    from std_msgs.msg import Float64

    file = tmp_path / "waits.py"
    file.write_text(LOOP + start)
    heard = []
    ros_runtime.world.topic("times", Float64).subscribe(lambda message: heard.append(message.data))
    program = ros_runtime.start(file)
    ros_runtime.sleep(5)

    assert heard == [pytest.approx(1.0, abs=0.02), pytest.approx(1.25, abs=0.02)]
    assert program.status == 0


def test_another_thread_wakes_a_loop(ros_runtime, tmp_path):
    file = tmp_path / "woken.py"
    file.write_text(
        """
import asyncio
import threading
import time


async def work():
    woken = asyncio.Event()
    loop = asyncio.get_running_loop()

    def wake():
        time.sleep(2.0)
        loop.call_soon_threadsafe(woken.set)

    threading.Thread(target=wake).start()
    begin = time.time()
    await woken.wait()
    assert 2.0 <= time.time() - begin < 2.1

asyncio.run(work())
"""
    )
    program = ros_runtime.start(file)
    ros_runtime.sleep(5)

    assert program.status == 0, ros_runtime.log(program.name)


def test_a_loop_that_waits_for_ever_ends_with_the_run(tmp_path):
    file = tmp_path / "waits.py"
    file.write_text("import asyncio\nasyncio.get_event_loop().run_forever()\n")

    assert main(["run", "--simulated", "--for", "3", str(file)]) == 0


ASKING = """
import asyncio
import threading

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.executors import SingleThreadedExecutor
from rclpy.task import Future

rclpy.init()
node = rclpy.create_node('asks')
client = node.create_client(AddTwoInts, 'add')
node.create_service(AddTwoInts, 'add', lambda request, response: response)
given_up = Future()


async def within(callback_ran):
    # The executor runs this coroutine, while a task of asyncio spins the executor.
    await client.call_async(AddTwoInts.Request())
    callback_ran.append('within')


async def spinning():
    while rclpy.ok():
        node.executor.spin_once(timeout_sec=0)
        await asyncio.sleep(0.01)


async def work():
    spinner = asyncio.create_task(spinning())
    ran = []
    node.executor.create_task(within, ran)
    answers = await asyncio.gather(
        client.call_async(AddTwoInts.Request()), client.call_async(AddTwoInts.Request())
    )
    await asyncio.sleep(0.1)
    threading.Timer(0.5, given_up.cancel).start()
    print(len(answers), ran, await given_up)
    try:
        await asyncio.wait_for(Future(), 0.5)
    except asyncio.TimeoutError:
        print('waited in vain')
    spinner.cancel()


node.executor = SingleThreadedExecutor()
node.executor.add_node(node)
asyncio.run(work())
"""


def test_a_task_of_asyncio_waits_for_what_rclpy_answers(ros_runtime, tmp_path, capfd):
    file = tmp_path / "asks.py"
    file.write_text(ASKING)
    program = ros_runtime.start(file)
    ros_runtime.sleep(5)

    assert capfd.readouterr().out.splitlines() == ["2 ['within'] None", "waited in vain"]
    assert program.status == 0
