"""Where rclpy and launch refuse or order things in a way that is easy to miss."""

import sys

import pytest


def test_the_executor_runs_a_futures_callbacks_after_the_answer_is_set(node):
    import rclpy
    from std_srvs.srv import Trigger

    seen = []
    node.create_service(Trigger, "ask", lambda request, response: response)
    client = node.create_client(Trigger, "ask")
    future = client.call_async(Trigger.Request())
    future.add_done_callback(lambda done: seen.append(done.result()))

    rclpy.spin_until_future_complete(node, future, timeout_sec=5.0)
    assert seen == []
    rclpy.spin_once(node, timeout_sec=0.0)
    assert len(seen) == 1


def test_a_future_without_an_executor_calls_back_at_once():
    from tftool.ros.rclpy.futures import Future

    seen, future = [], Future()
    future.add_done_callback(seen.append)
    future.set_result(1)
    future.add_done_callback(seen.append)

    assert seen == [future, future]


def test_a_thread_that_sleeps_by_a_rate_wakes_a_main_loop_of_spin_once(tftool, tmp_path):
    file = tmp_path / "rated.py"
    file.write_text(
        "import threading\nimport rclpy\nrclpy.init()\nnode = rclpy.create_node('rated')\n"
        "def pace():\n    rate = node.create_rate(2)\n"
        "    for _ in range(4):\n        rate.sleep()\n"
        "thread = threading.Thread(target=pace)\nthread.start()\n"
        "while thread.is_alive():\n    rclpy.spin_once(node)\n"
        "node.get_logger().info('left the loop')\n"
    )

    run = tftool("run", "--simulated", "--for", "10", str(file))
    assert "[1002.000000000] [rated]: left the loop" in run.err


def test_a_parameter_cannot_be_declared_to_have_no_type(node):
    from rcl_interfaces.msg import ParameterDescriptor
    from rclpy.parameter import Parameter

    with pytest.raises(ValueError, match="NOT_SET"):
        node.declare_parameter("plain", Parameter.Type.NOT_SET)
    with pytest.raises(ValueError, match="dynamic_typing"):
        node.declare_parameter(
            "both", Parameter.Type.STRING, ParameterDescriptor(dynamic_typing=True)
        )
    assert node.declare_parameter("any", descriptor=ParameterDescriptor(dynamic_typing=True))


def test_parameters_are_listed_to_no_negative_depth(node):
    with pytest.raises(ValueError, match="-1"):
        node.list_parameters([], -1)


ISATTY = "import sys; print('terminal' if sys.stdout.isatty() else 'pipe')"


@pytest.mark.parametrize("simulated", [True, False])
def test_a_process_writes_to_a_terminal_where_one_is_emulated(tftool, tmp_path, simulated):
    file = tmp_path / "tty.launch.py"
    file.write_text(
        "from launch import LaunchDescription\nfrom launch.actions import ExecuteProcess\n"
        "def generate_launch_description():\n"
        f"    cmd = [{sys.executable!r}, '-c', {ISATTY!r}]\n"
        "    return LaunchDescription([ExecuteProcess(cmd=cmd, name='with', emulate_tty=True),\n"
        "                              ExecuteProcess(cmd=cmd, name='without')])\n"
    )

    options = ("--simulated", "--for", "1") if simulated else ("--host",)
    run = tftool("launch", *options, str(file))
    assert run.status == 0, run.err
    assert "[with-1] terminal\n" in run.err
    assert "[without-2] pipe\n" in run.err


@pytest.mark.parametrize(("word", "expected"), [("yes", "new:old"), ("off", "old:new")])
def test_a_flag_of_xml_may_be_any_word_that_yaml_takes_for_one(tftool, tmp_path, word, expected):
    file = tmp_path / "env.launch.xml"
    file.write_text(
        '<launch><set_env name="SHAPES" value="old"/>'
        f'<append_env name="SHAPES" value="new" prepend="{word}"/>'
        '<log message="$(env SHAPES)"/></launch>'
    )

    run = tftool("launch", "--simulated", "--for", "1", str(file))
    assert expected in run.err, run.err
