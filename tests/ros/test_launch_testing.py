"""Tests of launch_testing, launch_testing_ros and launch_pytest: packages' own launch tests."""

import re

import pytest

# Imported before the inner test runs, because each run removes the modules that it imported.
import tftool.ros.launch_plugin
from tftool.ros.launch_testing.text import build_line_match, build_text_match, expect_output

assert tftool.ros.launch_plugin.MARKS

TALKER = """
import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
publisher = node.create_publisher(String, "chatter", 10)
count = 0


def publish():
    global count
    publisher.publish(String(data=f"Hello {count}"))
    node.get_logger().info(f"said {count}")
    print("printed", count)
    count += 1


node.create_timer(0.5, publish)
rclpy.spin(node)
"""

HEAD = """
import sys
import unittest
import launch
import launch_ros.actions
import launch_testing
import launch_testing.actions
import launch_testing.asserts
import launch_testing.event_handlers
import launch_testing.markers
import launch_testing.util
import pytest
import rclpy
from launch.actions import ExecuteProcess, TimerAction
from launch_testing_ros import WaitForTopics
from pathlib import Path
from std_msgs.msg import String

HERE = Path(__file__).parent
READY = launch_testing.actions.ReadyToTest


def talker(name):
    file = str(HERE / "talker.py")
    return launch_ros.actions.Node(
        executable=sys.executable, arguments=[file], name=name, remappings=[("chatter", name)]
    )


def python(code, *words, **options):
    return ExecuteProcess(cmd=[sys.executable, "-u", "-c", code, *words], **options)
"""

NODES = """
@pytest.mark.rostest
def generate_test_description():
    one = talker("one")
    described = [one, talker("other"), TimerAction(period=1.0, actions=[READY()])]
    return launch.LaunchDescription(described), {"one": one, "number": 3}


class TestBeside(unittest.TestCase):
    @classmethod
    def setUpClass(cls, number):
        rclpy.init()
        cls.number = number

    @classmethod
    def tearDownClass(cls):
        rclpy.shutdown()

    def setUp(self, launch_service):
        self.assertFalse(launch_service.context.argv)
        self.node = rclpy.create_node("test")

    def test_output(self, proc_output, proc_info, one):
        proc_info.assertWaitForStartup(process=one)
        proc_output.assertWaitFor("said 5", process=one, timeout=5)
        proc_output.assertWaitFor("printed 6", process=one, stream="stdout")
        self.assertFalse(proc_output.waitFor("said 99", process=one, timeout=0.1))
        with self.assertRaisesRegex(AssertionError, "Timed out waiting for process"):
            proc_info.assertWaitForShutdown(process=one, timeout=0.1)

    def test_messages(self):
        heard = []
        self.node.create_subscription(String, "one", heard.append, 10)
        while len(heard) < self.number:
            rclpy.spin_once(self.node)
        with WaitForTopics([("one", String), ("other", String)], timeout=2.0) as topics:
            assert topics.topics_received() == {"one", "other"}
            assert topics.received_messages("one")[0].data.startswith("Hello ")
        with pytest.raises(RuntimeError, match="none"), WaitForTopics([("none", String)], 0.5):
            pass


@launch_testing.post_shutdown_test()
class TestAfter(unittest.TestCase):
    def test_exit_codes(self, proc_info):
        launch_testing.asserts.assertExitCodes(proc_info)

    def test_output(self, proc_output, one):
        launch_testing.asserts.assertInStderr(proc_output, "said 0", one)
        with launch_testing.asserts.assertSequentialStdout(proc_output, one) as output:
            output.assertInStdout("printed 1")
            output.assertInStdout("printed 2")
            with self.assertRaisesRegex(AssertionError, "'printed 1' not found in sequence"):
                output.assertInStdout("printed 1")
"""

PROCESSES = """
@pytest.mark.launch_test
@launch_testing.parametrize("word, status", [("red", 0), ("blue", 3)])
def generate_test_description(word, status):
    said = "import sys; print(sys.argv[1]); sys.stderr.write('!'); sys.exit(int(sys.argv[2]))"
    process = python(said, word, str(status))
    stay = python("import signal, time\\nsignal.signal(2, lambda *_: exit(4))\\nprint('up')\\n"
                  "time.sleep(100)", name="stay")
    actions = [process, stay, launch_testing.util.KeepAliveProc(), READY()]
    return launch.LaunchDescription(actions), {"process": process, "stay": stay}


class TestBeside(unittest.TestCase):
    def test_it(self, proc_output, proc_info, process, stay, word, test_args):
        proc_output.assertWaitFor(word, process=process, cmd_args=word, stream="stdout")
        proc_output.assertWaitFor("!", process=process)
        proc_info.assertWaitForShutdown(process=process)
        proc_output.assertWaitFor("up", process=stay, stream="stdout")
        assert test_args == {"colour": "any"}


@launch_testing.post_shutdown_test()
class TestAfter(unittest.TestCase):
    def test_exit_codes(self, proc_info, process, stay, status):
        launch_testing.asserts.assertExitCodes(proc_info, [status], process)
        launch_testing.asserts.assertExitCodes(proc_info, [4], "stay")
        with self.assertRaisesRegex(AssertionError, "exited with code"):
            launch_testing.asserts.assertExitCodes(proc_info)
"""


@pytest.fixture
def run(pytester):
    """Return a function that runs files with `pytest --ros-free` and further words."""

    def tested(*words, **files):
        pytester.makepyfile(talker=TALKER, **files)
        given = ["--ros-free", "-p", "tftool.ros.pytest_plugin", "-p", "no:cacheprovider"]
        given += ["-W", "default::pytest.PytestCollectionWarning"]
        return pytester.runpytest(*given, *words)

    return tested


def test_a_launch_of_nodes_is_tested_while_it_runs_and_after_it(run):
    result = run(test_nodes=HEAD + NODES)

    result.assert_outcomes(passed=1)
    result = run("test_nodes.py", test_nodes=HEAD + NODES.replace("'printed 1' not", "gone"))
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*TestAfter.test_output*", "*'printed 1' not found in sequence*"])


@pytest.mark.parametrize(
    "handler",
    [
        "launch.event_handlers.OnProcessStart(target_action=one, on_start=[READY()])",
        "launch.event_handlers.OnProcessIO(target_action=one, on_stderr=None, on_stdout=READY())",
        "launch_testing.event_handlers.StdoutReadyListener("
        "target_action=one, ready_txt='printed 2', actions=[READY()])",
    ],
)
def test_an_event_may_start_the_tests(run, handler):
    described = f"""
@pytest.mark.launch_test
def generate_test_description():
    one = talker("one")
    ready = launch.actions.RegisterEventHandler({handler})
    return launch.LaunchDescription([ready, one])


class TestIt(unittest.TestCase):
    def test_it(self, proc_info):
        assert proc_info.processes()
"""
    run(test_it=HEAD + described).assert_outcomes(passed=1)


@pytest.mark.parametrize(
    ("process", "number", "told"),
    [
        ("python('import time; time.sleep(100)', name='one')", "'SIGTERM'", "returncode == -15"),
        ("python('import time; time.sleep(100)', name='one')", "9", "returncode == -9"),
        ("talker('one')", "2", "returncode == 0"),
    ],
)
def test_a_process_is_sent_a_signal(run, process, number, told):
    described = f"""
from launch.actions import EmitEvent
from launch.events import matches_action
from launch.events.process import SignalProcess


@pytest.mark.launch_test
def generate_test_description():
    one = {process}
    end = SignalProcess(signal_number={number}, process_matcher=matches_action(one))
    late = TimerAction(period=0.3, actions=[EmitEvent(event=end)])
    keep = launch_testing.util.KeepAliveProc()
    return launch.LaunchDescription([one, keep, late, READY()]), {{"one": one}}


class TestIt(unittest.TestCase):
    def test_it(self, proc_info, one):
        proc_info.assertWaitForShutdown(one, timeout=5)
        assert proc_info[one].{told}
"""
    run(test_it=HEAD + described).assert_outcomes(passed=1)


def test_a_test_that_is_a_process_is_ended_after_its_timeout(run):
    described = """
@pytest.mark.launch_test
def generate_test_description():
    test = launch_testing.actions.GTest(path="sleep", timeout=0.2, name="slow")
    test.cmd.append("100")
    late = launch.actions.TimerAction(period=0.1, actions=[READY()])
    return launch.LaunchDescription([test, launch_testing.util.KeepAliveProc(), late])


class TestIt(unittest.TestCase):
    def test_it(self, proc_info):
        proc_info.assertWaitForShutdown("slow", timeout=60)
        assert proc_info["slow"].returncode == -2
"""
    run(test_it=HEAD + described).assert_outcomes(passed=1)


def test_a_launch_of_processes_is_tested_once_for_each_of_its_parameters(run):
    run("--launch-args", "colour:=any", "--", test_processes=HEAD + PROCESSES).assert_outcomes(
        passed=1
    )


@pytest.mark.parametrize(
    ("described", "told"),
    [
        ("return launch.LaunchDescription([READY()])", "Launch stopped before the active tests"),
        ("return launch.LaunchDescription([])", "LaunchDescription containing a ReadyToTest"),
        (
            "return launch.LaunchDescription([launch_testing.util.KeepAliveProc(),"
            " TimerAction(period=16.0, actions=[READY()])])",
            "Timed out after 15 s waiting for processes to start up.",
        ),
        (
            "return launch.LaunchDescription([launch_ros.actions.Node(executable='x',"
            " package='nonesuch'), READY()])",
            "there is no package 'nonesuch'",
        ),
    ],
)
def test_a_launch_that_cannot_be_tested_fails_with_the_reason(run, described, told):
    waits = "class TestIt(unittest.TestCase):\n    def test_it(self, proc_output):\n        pass\n"
    mark = "@pytest.mark.launch_test\ndef generate_test_description():\n    "

    result = run(test_it=f"{HEAD}\n{mark}{described}\n\n\n{waits}")
    result.assert_outcomes(failed=1)
    assert told in result.stdout.str()


def test_markers_of_a_description(run):
    described = """
@pytest.mark.launch_test
@launch_testing.markers.keep_alive
@launch_testing.ready_to_test_action_timeout(20)
def generate_test_description():
    return launch.LaunchDescription([TimerAction(period=16.0, actions=[READY()])])


class TestIt(unittest.TestCase):
    runs = 0

    @launch_testing.markers.retry_on_failure(times=3, delay=1.0)
    def test_it(self):
        type(self).runs += 1
        assert self.runs == 3
"""
    skipped = """
@pytest.mark.launch_test
@unittest.skip("not today")
def generate_test_description():
    pass


class TestIt(unittest.TestCase):
    def test_it(self):
        pass
"""
    ordinary = "def generate_test_description():\n    pass\n\n\ndef test_it():\n    pass\n"
    run(
        test_marked=HEAD + described, test_skipped=HEAD + skipped, test_ordinary=ordinary
    ).assert_outcomes(passed=2, skipped=1)


PYTEST = """
import launch_pytest
from launch_pytest.tools import process as process_tools

ORDER = []


@pytest.fixture{scope}
def hello():
    return python("print('hello')", cached_output=True)


@launch_pytest.fixture{scope}
def described(hello):
    return launch.LaunchDescription([hello, launch_testing.util.KeepAliveProc()])


@pytest.mark.launch(fixture=described, shutdown=True)
def test_last(launch_service):
    assert launch_service.event_loop is None
    ORDER.append("last")


@pytest.mark.launch(fixture=described)
def test_function(hello, launch_context):
    def says_hello(output):
        assert output == "hello\\n"

    process_tools.assert_output_sync(launch_context, hello, says_hello, timeout=5)
    with pytest.raises(AssertionError):
        process_tools.assert_stderr_sync(launch_context, hello, says_hello, timeout=0.1)
    ORDER.append("function")


@pytest.mark.launch(fixture=described)
async def test_coroutine(hello, launch_context):
    assert await process_tools.wait_for_start(launch_context, hello, timeout=5)
    assert await process_tools.wait_for_exit(launch_context, hello, timeout=5)
    assert not await process_tools.wait_for_output(launch_context, hello, str.isupper, 0.1)
    ORDER.append("coroutine")


@pytest.mark.launch(fixture=described)
def test_generator(hello, launch_context):
    assert process_tools.wait_for_exit_sync(launch_context, hello, timeout=5)
    ORDER.append("before")
    yield
    ORDER.append("after")
    assert hello.return_code == 0


@pytest.mark.launch(fixture=described)
async def test_async_generator():
    ORDER.append("async before")
    yield
    ORDER.append("async after")


@pytest.mark.launch
def test_without_a_fixture():
    pass


def test_order():
    assert ORDER == {order}
"""


def test_tests_beside_the_launch_of_a_fixture(run):
    order = ["last", "function", "coroutine", "before", "after", "async before", "async after"]

    result = run(test_it=HEAD + PYTEST.format(scope="", order=order))
    result.assert_outcomes(passed=6, skipped=1, warnings=2)
    result.stdout.fnmatch_lines(['*"fixture" keyword argument is required in a*'])


def test_tests_that_share_a_launch_go_before_those_after_its_end(run):
    order = ["function", "coroutine", "before", "async before", "last", "after", "async after"]

    result = run(test_it=HEAD + PYTEST.format(scope="(scope='module')", order=order))
    result.assert_outcomes(passed=8, skipped=1)


@pytest.mark.parametrize(
    ("body", "told"),
    [
        ("    return [1]", "must be either a launch description or a sequence"),
        (
            "    return launch.LaunchDescription([READY(), READY()])",
            "containing only one ReadyToTest action",
        ),
    ],
)
def test_a_fixture_that_launches_nothing_is_an_error(run, body, told):
    text = f"""
import launch_pytest

@launch_pytest.fixture
def described():
{body}


@pytest.mark.launch(fixture=described)
def test_it():
    pass
"""
    result = run(test_it=HEAD + text)
    result.assert_outcomes(errors=1)
    assert told in result.stdout.str()


WRONG = """
import launch_pytest


@launch_pytest.fixture(scope="{scope}")
def described():
    return launch.LaunchDescription([launch_testing.util.KeepAliveProc()])


@pytest.mark.launch(fixture=described{more})
{kind} test_it():
    {before}
    yield
    {after}
"""


@pytest.mark.parametrize("kind", ["def", "async def"])
@pytest.mark.parametrize(
    ("scope", "more", "before", "after", "outcome"),
    [
        ("function", "", "pass", "yield", {"failed": 1}),
        ("module", "", "pass", "yield", {"passed": 1, "failed": 1}),
        ("module", "", "assert False", "pass", {"failed": 1, "skipped": 1}),
        ("function", ", shutdown=True", "pass", "pass", {"failed": 1}),
    ],
)
def test_a_wrong_generator_fails(run, kind, scope, more, before, after, outcome):
    text = WRONG.format(kind=kind, scope=scope, more=more, before=before, after=after)
    run(test_it=HEAD + text).assert_outcomes(**outcome)


def test_a_conftest_may_import_rclpy_at_its_top(run):
    conftest = "import rclpy\nimport pytest\n\n\n@pytest.fixture\ndef node(ros_runtime):\n"
    conftest += "    rclpy.init()\n    return rclpy.create_node('shared')\n"

    run(
        conftest=conftest, test_it="def test_it(node):\n    assert node.get_name() == 'shared'\n"
    ).assert_outcomes(passed=1)


def test_a_file_of_launch_tests_is_run_by_name(tmp_path, tftool, simulated, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "talker.py").write_text(TALKER)
    (tmp_path / "robot" / "robot").mkdir(parents=True)
    (tmp_path / "robot" / "robot" / "__init__.py").touch()
    (tmp_path / "robot" / "package.xml").write_text("<package><name>robot</name></package>")
    file = tmp_path / "nodes.test.py"
    # The mark is removed, because the pytest that runs this test does not know it.
    text = (
        "import robot, sys\nassert sys.argv[0] == 'launch_test'\n"
        + HEAD
        + NODES.replace("@pytest.mark.rostest\n", "")
    )
    file.write_text(text)

    passed = tftool("ros2", "test", file)
    assert (passed.status, passed.err.count("... ok")) == (0, 4)
    file.write_text(text.replace("Hello", "Bye"))
    failed = tftool("run", "launch_testing", "launch_test", file)
    assert (failed.status, "FAILED (failures=1)" in failed.err) == (1, True)
    assert tftool("ros2", "test").status == 2
    assert tftool("ros2", "test", tmp_path / "none.py").status == 3
    file.write_text("x = 1\n")
    assert "it has no function generate_test_description()" in tftool("ros2", "test", file).err


@pytest.mark.parametrize(
    ("expected", "strict", "found"),
    [
        ("b\nc", False, (2, 5)),
        ("b", True, None),
        (["a", "c"], False, (0, 5)),
        (["c", "a"], False, None),
        (re.compile(r"[bc]\n"), False, (2, 4)),
        (["a\n", re.compile("b")], True, (0, 3)),
        (["a", "b"], True, None),
    ],
)
def test_texts_are_found_in_output(expected, strict, found):
    assert build_text_match(expected, strict=strict)("a\r\nb\nc\n") == found
    assert expect_output("\x1b[1ma\x1b[0m\nb\nc\n", expected_text=expected, strict=strict) is bool(
        found
    )


@pytest.mark.parametrize(
    ("expected", "strict", "found"),
    [
        ("b", False, (1, 2)),
        (["a", re.compile("c$")], False, (0, 3)),
        (["a", "c"], True, None),
        (["a", "b"], True, (0, 2)),
        (re.compile("[abc]"), True, (0, 3)),
        ("a", True, None),
    ],
)
def test_lines_are_found_in_output(expected, strict, found):
    assert build_line_match(expected, strict=strict)(["a", "b", "c"], 0) == found
