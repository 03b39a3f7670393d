import array
import copy
import math
import sys
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import pytest

from tftool.base.errors import InputError
from tftool.messages.classes import INTERFACES, Interfaces, duplicate


def message(name, **fields):
    return INTERFACES.message(name)(**fields)


@pytest.mark.parametrize("package", sorted(INTERFACES.packages()))
def test_every_definition_makes_a_class_whose_default_equals_itself(package):
    for kind in ("msg", "srv", "action"):
        for name in INTERFACES.names(package, kind):
            made = INTERFACES.find(package, kind, name)
            parts = {"msg": [made], "srv": ["Request", "Response"]}.get(
                kind, ["Goal", "Result", "Feedback"]
            )
            for part in parts:
                cls = part if kind == "msg" else getattr(made, part)
                assert cls() == cls()
                assert repr(cls()).startswith(f"{package}.{kind}.{name}")


def test_defaults_are_those_of_the_definitions():
    stamped = message("geometry_msgs/TransformStamped")

    assert stamped.transform.rotation.w == 1.0
    assert stamped.header.frame_id == ""
    assert stamped.header.stamp.sec == 0
    assert list(message("geometry_msgs/PoseWithCovariance").covariance) == [0.0] * 36


def test_keywords_set_fields_and_the_text_shows_all_of_them():
    point = message("geometry_msgs/Point", x=1.0, z=-2.5)

    assert repr(point) == "geometry_msgs.msg.Point(x=1.0, y=0.0, z=-2.5)"


def test_a_service_has_a_request_and_a_response():
    spawn = INTERFACES.find("turtlesim", "srv", "Spawn")

    assert repr(spawn.Request(x=1.5)) == (
        "turtlesim.srv.Spawn_Request(x=1.5, y=0.0, theta=0.0, name='')"
    )
    assert spawn.Response().name == ""


def test_an_unknown_keyword_is_refused_by_name():
    with pytest.raises(AssertionError, match=r"Invalid arguments passed to constructor: q \(Point"):
        message("geometry_msgs/Point", q=1.0)


@pytest.mark.parametrize(
    ("kind", "field", "value", "told"),
    [
        ("geometry_msgs/Point", "x", 1, r"'x' field must be of type 'float', not 'int': write 1.0"),
        ("geometry_msgs/Point", "x", "1", r"'x' field must be of type 'float', not 'str'"),
        ("std_msgs/Int8", "data", 128, r"'data' field must be an integer in \[-128, 127\]"),
        ("std_msgs/UInt8", "data", -1, r"'data' field must be an unsigned integer in \[0, 255\]"),
        ("std_msgs/Int32", "data", 1.0, r"'data' field must be of type 'int'"),
        ("std_msgs/Float32", "data", 1e39, r"'data' field must be a float in"),
        ("std_msgs/Bool", "data", 1, r"'data' field must be of type 'bool'"),
        ("std_msgs/String", "data", b"x", r"'data' field must be of type 'str'"),
        ("std_msgs/Byte", "data", b"xy", r"'data' field must be of type 'bytes' with length 1"),
        ("geometry_msgs/Pose", "position", 3, r"must be a sub message of type 'Point', not 'int'"),
        ("geometry_msgs/Polygon", "points", 3, r"'points' field must be a set or sequence"),
        ("geometry_msgs/Polygon", "points", [3], r"must be a sub message of type 'Point32'"),
        ("geometry_msgs/Polygon", "points", "ab", r"'points' field must be a set or sequence"),
        ("geometry_msgs/PoseWithCovariance", "covariance", [1.0], r"with length 36, not 1"),
        ("sensor_msgs/JointState", "position", [1], r"'position' field must be of type 'float'"),
    ],
)
def test_an_assignment_is_checked_as_ros_2_checks_it(kind, field, value, told):
    made = message(kind)
    before = duplicate(made)

    with pytest.raises(AssertionError, match=told):
        setattr(made, field, value)

    assert made == before


def test_a_field_that_does_not_exist_cannot_be_set():
    with pytest.raises(AttributeError):
        message("geometry_msgs/Point").w = 1.0


def test_infinity_fits_a_32_bit_field_and_not_a_number_too():
    made = message("std_msgs/Float32", data=math.inf)
    made.data = math.nan

    assert math.isnan(made.data)


def test_sequences_of_numbers_are_arrays_and_others_are_lists():
    scan = message("sensor_msgs/LaserScan", ranges=[1.0, 2.0])
    cloud = message("sensor_msgs/PointCloud2", data=b"\x01\x02")

    assert scan.ranges == array.array("f", [1.0, 2.0])
    assert cloud.data == array.array("B", [1, 2])
    assert cloud.fields == []
    scan.ranges = array.array("f", [3.0])
    assert list(scan.ranges) == [3.0]


def test_constants_are_attributes_of_the_class():
    assert INTERFACES.message("sensor_msgs/PointField").FLOAT32 == 7
    assert INTERFACES.find("action_msgs", "msg", "GoalStatus").STATUS_SUCCEEDED == 4


def test_messages_compare_by_value_and_cannot_be_hashed():
    one, other = message("geometry_msgs/Point", x=1.0), message("geometry_msgs/Point", x=1.0)

    assert one == other
    assert one != message("geometry_msgs/Vector3", x=1.0)
    assert message("geometry_msgs/PoseWithCovariance") == message(
        "geometry_msgs/PoseWithCovariance"
    )
    with pytest.raises(TypeError):
        hash(one)


def test_a_deep_copy_shares_nothing_and_a_copy_shares_what_is_inside():
    pose = message("geometry_msgs/Pose")
    deep, flat = copy.deepcopy(pose), copy.copy(pose)
    pose.position.x = 5.0

    assert deep.position.x == 0.0
    assert flat.position.x == 5.0


def test_32_bit_fields_are_rounded_on_their_way():
    sent = message("turtlesim/Pose", x=0.1)

    assert duplicate(sent).x == pytest.approx(0.1, abs=1e-8)
    assert duplicate(sent).x != 0.1
    assert math.isinf(duplicate(message("std_msgs/Float32", data=math.inf)).data)


def test_field_types_are_told_as_ros_2_writes_them():
    kinds = INTERFACES.message("geometry_msgs/PoseWithCovarianceStamped")

    assert kinds.get_fields_and_field_types() == {
        "header": "std_msgs/Header",
        "pose": "geometry_msgs/PoseWithCovariance",
    }
    assert (
        INTERFACES.message("geometry_msgs/PoseWithCovariance").get_fields_and_field_types()[
            "covariance"
        ]
        == "double[36]"
    )
    assert INTERFACES.message("geometry_msgs/Polygon").get_fields_and_field_types() == {
        "points": "sequence<geometry_msgs/Point32>"
    }


def test_a_workspace_can_add_definitions_of_its_own():
    own = Interfaces()
    own.add(
        "pkg_interfaces",
        {
            ("msg", "Sphere"): (
                '# a ball\nstring<=3 name "abc"\nfloat64[2] limits [1.0, 2.0]\n'
                "geometry_msgs/Point center\nint8[<=2] few\nbool shiny true\nbyte flags 4\n"
                "string SPHERE=round"
            )
        },
    )
    sphere = own.message("pkg_interfaces/Sphere")()

    assert sphere.name == "abc"
    assert list(sphere.limits) == [1.0, 2.0]
    assert sphere.shiny is True
    assert sphere.flags == b"\x04"
    assert sphere.SPHERE == "round"
    with pytest.raises(AssertionError, match="not longer than 3"):
        sphere.name = "abcd"
    with pytest.raises(AssertionError, match="at most 2, not 3"):
        sphere.few = [1, 2, 3]


@pytest.mark.parametrize(
    ("key", "text", "told"),
    [
        (("msg", "A"), "float64", "'float64' is not a field; write 'type name'"),
        (("msg", "A"), "Unknown x", "field 'x': there is no interface pkg/msg/Unknown"),
        (("srv", "A"), "int8 x", "needs 2 parts separated by '---', but has 1"),
    ],
)
def test_a_wrong_definition_is_refused_with_its_name(key, text, told):
    own = Interfaces()
    own.add("pkg", {key: text})

    with pytest.raises(InputError, match=f"pkg/{key[0]}/A") as refused:
        own.find("pkg", *key)

    assert told in str(refused.value)


def test_a_message_that_contains_itself_is_refused_with_the_fields_that_lead_there():
    own = Interfaces()
    own.add(
        "pkg",
        {("msg", "Shop"): "Tree[] stock", ("msg", "Tree"): "Branch b", ("msg", "Branch"): "Tree t"},
    )

    with pytest.raises(InputError) as refused:
        own.message("pkg/Shop")

    assert str(refused.value) == (
        "pkg/msg/Shop: field 'stock': pkg/msg/Tree: field 'b': pkg/msg/Branch: field 't': "
        "pkg/msg/Tree contains itself, so no message of this type can exist"
    )


@pytest.mark.parametrize(
    ("line", "value"),
    [
        ('uint8 x 7 # so called "seven"', 7),
        ("uint8 x 7 # the node's own", 7),
        ('string x "a # b"  # a comment', "a # b"),
        ("string x 'a # b'", "a # b"),
        ("string x it's # a comment", "it's"),
    ],
)
def test_a_comment_may_hold_quotes_and_quotes_may_hold_its_sign(line, value):
    known = Interfaces()
    known.add("pkg", {("msg", "Said"): f"# about it\n{line}\n"})

    assert known.find("pkg", "msg", "Said")().x == value


def test_a_constants_comment_may_hold_quotes():
    known = Interfaces()
    known.add("pkg", {("msg", "Said"): 'uint8 SEVEN=7 # so called "seven"\n'})

    assert known.find("pkg", "msg", "Said").SEVEN == 7


@pytest.mark.parametrize("name", ["Int16", "Float32MultiArray", "MultiArrayLayout", "Char"])
def test_example_interfaces_have_what_std_msgs_has(name):
    ours = INTERFACES.message(f"example_interfaces/{name}")
    theirs = INTERFACES.message(f"std_msgs/{name}")

    assert ours is not theirs
    assert ours.get_fields_and_field_types() == {
        field: kind.replace("std_msgs", "example_interfaces")
        for field, kind in theirs.get_fields_and_field_types().items()
    }


def test_a_service_has_its_event_and_an_action_what_ros_2_makes_of_it():
    event = INTERFACES.find("std_srvs", "srv", "SetBool").Event
    fibonacci = INTERFACES.find("example_interfaces", "action", "Fibonacci")
    send, ask = fibonacci.Impl.SendGoalService, fibonacci.Impl.GetResultService
    goal = fibonacci.Goal(order=3)

    assert event(request=[INTERFACES.part("std_srvs/srv/SetBool_Request")(data=True)]).request
    assert send.Request(goal=goal).goal == goal
    assert send.Response().accepted is False
    assert send.interface__ == "example_interfaces/action/Fibonacci_SendGoal"
    assert send is fibonacci.Impl.SendGoalService
    assert ask.Response(result=fibonacci.Result(sequence=[1]), status=4).status == 4
    assert fibonacci.Impl.FeedbackMessage().feedback == fibonacci.Feedback()
    assert fibonacci.Impl.CancelGoalService is INTERFACES.find("action_msgs", "srv", "CancelGoal")
    assert fibonacci.Impl.GoalStatusMessage().status_list == []


def test_threads_that_need_one_class_at_the_same_time_get_the_same_class():
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        for _ in range(10):
            interfaces, start = Interfaces(), Barrier(8)

            def ask(interfaces=interfaces, start=start):
                start.wait()
                return (
                    interfaces.message("nav_msgs/Odometry"),
                    interfaces.find("lifecycle_msgs", "srv", "ChangeState"),
                )

            with ThreadPoolExecutor(8) as pool:
                found = {one.result() for one in [pool.submit(ask) for _ in range(8)]}
            assert len(found) == 1
    finally:
        sys.setswitchinterval(before)


def test_a_package_can_be_added_while_other_threads_create_classes():
    interfaces = Interfaces()
    for number in range(400):
        interfaces.add(f"known{number}", {("msg", "One"): "int32 x"})

    def create():
        for number in range(400):
            interfaces.message(f"known{number}/One")

    def add():
        for number in range(400):
            interfaces.add(f"added{number}", {("msg", "One"): "int32 x"})

    switch = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(2) as pool:
            done = [pool.submit(work) for work in (create, add)]
    finally:
        sys.setswitchinterval(switch)

    assert [one.exception() for one in done] == [None, None]
    assert interfaces.message("added399/One")().x == 0
