import json

import pytest
from rich.cells import cell_len

from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.buffer.traffic import NetDelay, Traffic
from tftool.drawing import traffic_view as monitor
from tftool.geometry.rigid import Transform


def sample(child, stamp, parent="world"):
    return TransformStamped(seconds(stamp), parent, child, Transform())


def traffic(*messages, authority="broadcaster1", is_static=False):
    heard = Traffic()
    for now, *transforms in messages:
        heard.receive(
            seconds(now),
            [sample(child, stamp) for child, stamp in transforms],
            authority,
            is_static=is_static,
        )
    return heard


def steady():
    return traffic(*[(10 + n * 0.1, ("turtle1", 10 + n * 0.1 - 0.02)) for n in range(11)])


def chain():
    delay = NetDelay()
    for value in (0.1, 0.2, 0.3):
        delay.add(value)
    return monitor.Chain("turtle2", "turtle1", ("turtle1", "world", "turtle2"), delay)


def test_rates_count_the_gaps_and_not_the_messages():
    series = steady().links["turtle1"].series

    assert series.rate == pytest.approx(10.0)
    assert series.tf2_rate == pytest.approx(11.0)
    assert series.average_delay == pytest.approx(0.02)
    assert series.maximum_delay == pytest.approx(0.02)


def test_a_lone_message_has_no_rate_and_a_static_no_delay():
    lone = traffic((10.0, ("s", 0.0)), is_static=True).links["s"].series

    assert lone.rate is None
    assert lone.average_delay is None
    assert lone.maximum_delay is None
    assert lone.tf2_average_delay == 10.0


def test_a_stamp_from_the_future_shows_as_negative_delay():
    series = traffic((5.0, ("f", 6.0))).links["f"].series

    assert series.maximum_delay == -1.0
    assert series.tf2_maximum_delay == 0.0


def test_only_the_newest_thousand_messages_count():
    heard = traffic(*[(n * 1.0, ("a", 0.0)) for n in range(1, 11)])
    for n in range(1000):
        heard.receive(seconds(100 + n * 0.5), [sample("a", 100 + n * 0.5)], "x")

    series = heard.links["a"].series
    assert series.total == 1010
    assert series.rate == pytest.approx(2.0)
    assert series.average_delay == 0.0


def test_a_message_without_transforms_is_nobodys():
    assert not traffic((1.0,)).senders


def test_a_report_on_all_frames_reads_like_tf2_monitors():
    heard = steady()
    heard.receive(seconds(11), [sample("arm", 10.5)], "arm_node")

    assert monitor.lines(heard).split("\n") == [
        "",
        "",
        "",
        "RESULTS: for all Frames",
        "",
        "Frames:",
        "Frame: arm, published by arm_node, Average Delay: 0.5, Max Delay: 0.5",
        "Frame: turtle1, published by broadcaster1, Average Delay: 0.02, Max Delay: 0.02",
        "",
        "All Broadcasters:",
        "Node: arm_node unknown Hz, Average Delay: 0.5 Max Delay: 0.5",
        "Node: broadcaster1 10 Hz, Average Delay: 0.02 Max Delay: 0.02",
        "",
    ]


def test_a_report_on_a_chain_says_which_way_it_is_read_and_lists_only_its_links():
    heard = steady()
    heard.receive(seconds(11), [sample("arm", 10.5)], "arm_node")

    lines = monitor.lines(heard, chain()).split("\n")

    assert lines[3:6] == [
        "RESULTS: for turtle1 in turtle2",
        "Chain is: turtle1 -> world -> turtle2",
        "Net delay     avg = 0.2: max = 0.3",
    ]
    assert not any(line.startswith("Frame: arm") for line in lines)


def test_tf2_monitors_own_numbers_are_there_to_compare_with():
    heard = traffic((1757685977.25, ("s", 0.0)), authority="<no authority available>")

    assert monitor.lines(heard, as_tf2=True).split("\n")[6:10] == [
        "Frame: s, published by <no authority available>, Average Delay: 1.75769e+09, "
        "Max Delay: 1.75769e+09",
        "",
        "All Broadcasters:",
        "Node: <no authority available> 1e+08 Hz, Average Delay: 1.75769e+09 "
        "Max Delay: 1.75769e+09",
    ]
    assert "Net delay     avg = 0.0059601: max = 0.3" in monitor.lines(
        heard, chain(), as_tf2=True
    ).split("\n")


def shown(*words, width=90, height=40, **options):
    text = monitor.table(*words, width=width, height=height, **options)
    lines = [line.plain for line in text.split("\n", allow_blank=True)]
    assert max(map(cell_len, lines)) <= width
    return lines


def test_the_table_shows_milliseconds_bars_and_statics_as_such():
    heard = steady()
    heard.receive(seconds(11), [sample("A\x1b", 0)], "static[b]", is_static=True)

    assert shown(seconds(11.5), seconds(10), heard) == [
        "All frames, for 2 s",
        "",
        "frame    in     broadcaster       rate              delay      max",
        "A␛       world  static[b]       static                  -        -",
        "turtle1  world  broadcaster1  10.00 Hz  ▇▇▇▇▇▇▇▇  20.0 ms  20.0 ms",
        "",
        "broadcaster       rate              delay      max",
        "broadcaster1  10.00 Hz  ▇▇▇▇▇▇▇▇  20.0 ms  20.0 ms",
        "static[b]            -                  -        -",
    ]


def test_bars_are_as_long_as_rates_are_high():
    heard = steady()
    for n in range(6):
        heard.receive(seconds(10 + n * 0.2), [sample("slow", 10 + n * 0.2)], "b")

    lines = shown(seconds(11.1), seconds(10), heard, ascii_only=True)

    assert [line.count("#") for line in lines[3:5]] == [4, 8]


def test_the_table_of_a_chain_has_its_links_in_its_order():
    heard = steady()
    for n in range(3):
        heard.receive(seconds(10.5 + n * 0.2), [sample("eye", 10.5, "turtle1")], "b")
    delay = NetDelay()
    delay.add(0.2)
    way = monitor.Chain("world", "eye", ("eye", "turtle1", "world"), delay)

    lines = shown(seconds(11), seconds(10), heard, way)

    assert lines[0] == (
        "eye in world, for 1 s, by way of eye, turtle1, world: net delay 200.0 ms on average, 200.0"
    )
    assert lines[1] == "ms at most"
    assert [line.split()[0] for line in lines[4:6]] == ["eye", "turtle1"]
    away = monitor.Chain("eye", "world", ("world", "turtle1", "eye"), delay)
    there = shown(seconds(11), seconds(10), heard, away)
    assert [line.split()[0] for line in there[4:6]] == ["turtle1", "eye"]


def styles(text, word):
    (line,) = [line for line in text.split("\n") if line.plain.startswith(word)]
    return {str(span.style) for span in line.spans if line.plain[span.start : span.end].strip()}


@pytest.mark.parametrize(
    ("now", "told", "style"), [(13, "2.0 s ago", "yellow"), (40, "29.0 s ago", "red")]
)
def test_a_link_not_heard_of_is_amber_then_red(now, told, style):
    heard = steady()

    text = monitor.table(seconds(now), seconds(10), heard, width=90, height=40)

    assert told in text.plain
    assert style in styles(text, "turtle1")


def test_a_link_that_is_dated_long_before_it_arrives_is_amber():
    heard = traffic(
        *[(10 + n * 0.1, ("map", 9 + n * 0.1), ("odom", 10 + n * 0.1)) for n in range(9)]
    )

    text = monitor.table(seconds(11), seconds(10), heard, width=90, height=40)

    assert "yellow" in styles(text, "map")
    assert "yellow" not in styles(text, "odom")


@pytest.mark.parametrize("width", [24, 40, 60, 80, 120])
def test_the_table_fits_a_terminal_and_says_how_many_frames_more_there_are(width):
    heard = traffic(
        *[(10 + n * 0.1, *[(f"link_{k:02}", 10 + n * 0.1) for k in range(60)]) for n in range(3)]
    )

    lines = shown(seconds(11), seconds(10), heard, width=width, height=23)

    assert len(lines) == 23
    assert "44 more" in lines
    assert "".join(lines).count("link_") == 16


def test_programs_get_plain_numbers_and_null_for_none():
    heard = steady()
    heard.receive(seconds(11), [sample("A", 0)], "publisher", is_static=True)

    data = monitor.as_object(seconds(21), heard, chain())

    assert json.loads(json.dumps(data, allow_nan=False)) == data
    assert data["at_ns"] == seconds(21)
    assert data["target"] == "turtle2"
    assert data["chain"] == ["turtle1", "world", "turtle2"]
    assert data["net_delay"] == {"average": pytest.approx(0.2), "max": 0.3}
    assert [frame["frame"] for frame in data["frames"]] == ["turtle1"]
    assert data["frames"][0]["rate"] == pytest.approx(10.0)
    assert data["broadcasters"][1] == {
        "broadcaster": "publisher",
        "messages": 1,
        "rate": None,
        "average_delay": None,
        "max_delay": None,
    }
    assert "chain" not in monitor.as_object(seconds(21), heard)
