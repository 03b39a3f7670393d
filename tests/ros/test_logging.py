"""Tests of a node's log."""

import pytest


def test_loggers_speak_under_their_names_from_their_level_on(node, ros_runtime):
    from rclpy.logging import LoggingSeverity, get_logger, set_logger_level

    logger = node.get_logger()
    logger.debug("unheard")
    logger.info("one")
    logger.warn("two")
    logger.get_child("part").error("three")
    get_logger("free").fatal("four")
    logger.set_level(LoggingSeverity.ERROR)
    logger.warning("unheard")
    set_logger_level("probe", LoggingSeverity.DEBUG)
    logger.debug("five")

    said = [(record.node, record.level, record.text) for record in ros_runtime.world.log.records]
    assert said == [
        ("probe", "INFO", "one"),
        ("probe", "WARN", "two"),
        ("probe.part", "ERROR", "three"),
        ("free", "FATAL", "four"),
        ("probe", "DEBUG", "five"),
    ]
    assert logger.is_enabled_for(LoggingSeverity.DEBUG)
    for make in (lambda: get_logger(""), lambda: logger.get_child("")):
        with pytest.raises(ValueError, match="must not be empty"):
            make()


def test_a_line_can_be_said_once_or_seldom(node, ros_runtime):
    for _ in range(3):
        node.get_logger().info("once", once=True)
        node.get_logger().info("seldom", throttle_duration_sec=1.5)
        node.get_logger().info("not first", skip_first=True)
        ros_runtime.sleep(1.0)

    assert ros_runtime.log("probe") == ["once", "seldom", "not first", "seldom", "not first"]


def test_two_filters_of_a_line_hold_together(node, ros_runtime):
    logger = node.get_logger()
    for turn in range(4):
        logger.info(f"second {turn}", once=True, skip_first=True)
        logger.info(f"later {turn}", throttle_duration_sec=1.5, skip_first=True)
        logger.info("a", once=True), logger.info("b", once=True)
        ros_runtime.sleep(1.0)
    logger.log("named", 20, name="other")
    with pytest.raises(TypeError, match="thrice"):
        logger.info("a", thrice=True)

    assert ros_runtime.log("probe") == ["a", "b", "second 1", "later 2"]
    assert ros_runtime.log("other") == ["named"]


def test_a_log_level_asked_for_on_the_command_line_holds(ros_runtime):
    import rclpy

    rclpy.init()
    node = rclpy.create_node("probe", cli_args=["--ros-args", "--log-level", "debug"])
    node.get_logger().debug("heard")

    assert ros_runtime.log("probe") == ["heard"]


def test_messages_of_a_node_and_its_child_loggers_appear_on_rosout(node, ros_runtime):
    import rclpy
    from rcl_interfaces.msg import Log
    from rclpy.logging import get_logger

    heard = []
    node.create_subscription(Log, "/rosout", heard.append, 10)
    node.get_logger().info("one")
    node.get_logger().get_child("part").warning("two")
    get_logger("nobody").error("of no node")
    rclpy.spin_once(node)
    rclpy.spin_once(node)
    rclpy.spin_once(node, timeout_sec=1.0)

    assert [(one.name, one.level, one.msg) for one in heard] == [
        ("probe", Log.INFO[0], "one"),
        ("probe.part", Log.WARN[0], "two"),
    ]
    assert heard[0].file == __file__
    assert heard[0].function == "test_messages_of_a_node_and_its_child_loggers_appear_on_rosout"


@pytest.mark.parametrize("by", ["node", "arguments"])
def test_rosout_can_be_switched_off(ros_runtime, by):
    import rclpy

    rclpy.init(args=["--ros-args", "--disable-rosout-logs"] if by == "arguments" else None)
    quiet = rclpy.create_node("quiet", enable_rosout=by == "arguments")

    assert quiet.count_publishers("/rosout") == 0


def test_one_call_in_the_code_must_log_alike_every_time(node):
    levels = ["info", "info", "warn"]

    def log(level, **settings):
        from rclpy.logging import get_logging_severity_from_string as severity

        node.get_logger().log("a line", severity(level), **settings)

    log(levels[0])
    log(levels[1])
    with pytest.raises(ValueError, match="severity cannot be changed"):
        log(levels[2])
    with pytest.raises(ValueError, match="name cannot be changed"):
        log("info", name="other")
    with pytest.raises(ValueError, match="parameters cannot be changed"):
        log("info", once=True)


def test_a_node_serves_the_levels_of_its_loggers_if_asked_to(ros_runtime):
    import rclpy
    from rcl_interfaces.msg import LoggerLevel
    from rcl_interfaces.srv import GetLoggerLevels, SetLoggerLevels

    rclpy.init()
    served = rclpy.create_node("served", enable_logger_service=True)

    def ask(kind, name, **request):
        client = served.create_client(kind, f"served/{name}")
        return client.call(kind.Request(**request), timeout_sec=5.0)

    wanted = [LoggerLevel(name="served", level=10), LoggerLevel(name="other", level=22)]
    results = ask(SetLoggerLevels, "set_logger_levels", levels=wanted).results
    levels = ask(GetLoggerLevels, "get_logger_levels", names=["served", "other"]).levels

    assert [one.successful for one in results] == [True, False]
    assert "Invalid logger level" in results[1].reason
    assert [(one.name, one.level) for one in levels] == [("served", 10), ("other", 0)]
    assert served.get_logger().debug("is said now")
