"""A node's log."""

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
