import math

import pytest
from rich.cells import cell_len

from tftool.base.stamps import seconds
from tftool.buffer.sample import FrameInfo, Snapshot, TransformStamped
from tftool.drawing import theme
from tftool.drawing.plane import PlanePicture
from tftool.geometry.rigid import Transform
from tftool.screens.terminal import panel_text as panels
from tftool.screens.terminal.log_lines import Journal
from tftool.screens.terminal.panel_text import Hint
from tftool.screens.terminal.scene import Pair, SceneMoment
from tftool.screens.terminal.text_style import Look, wrapped
from tftool.world.log import LogRecord

NASTY = ["[bold]x[/]", "\x1b[31mred", "a\nb", "x" * 500, "שלום", "🐢🐢", "\u202eevil"]
PLAIN = Look()
ASCII = Look(ascii_only=True)


def info(frame, parent, *, static=False, samples=627, rate=62.6, root="world", authority="b1"):
    return FrameInfo(
        frame=frame,
        parent=parent,
        is_static=static,
        authority=None if parent is None else authority,
        samples=samples,
        rate=10000.0 if static else rate,
        oldest=0,
        newest=0,
        buffer_length=0,
        age=0,
        transform=Transform(),
        root=root,
        root_from_frame=Transform(),
    )


def moment(*frames, ages=None, pair=None, behind=0):
    snapshot = Snapshot(seconds(1010), 0, frames)
    return SceneMoment(
        stamp=seconds(1010),
        behind=behind,
        elapsed=seconds(10),
        snapshot=snapshot,
        ages=ages or {},
        picture=PlanePicture(),
        pair=pair or Pair("turtle2", "turtle1"),
    )


WORLD = info("world", None)
TREE = moment(
    WORLD,
    info("turtle1", "world"),
    info("carrot1", "turtle1", static=True, authority="carrot"),
    info("turtle2", "world"),
)


def tree(shown, cursor="turtle1", width=34, height=9, look=PLAIN):
    listed = panels.rows(shown.snapshot, ascii_only=look.ascii_only)
    return panels.tree(shown, listed, cursor, width, height, look)


def words(lines):
    return [line.plain.rstrip() for line in lines]


def test_the_tree_shows_every_link_with_its_rate_and_age():
    assert words(tree(TREE)) == [
        "  frame            Hz          age",
        "  world",
        "▸ ├turtle1       62.6        0.0 s",
        "  │└carrot1                 static",
        " ◎└turtle2       62.6        0.0 s",
    ]
    assert words(tree(TREE, width=36))[3] == "  │  └─ carrot1               static"


def test_the_tree_in_plain_characters():
    assert words(tree(TREE, look=ASCII, width=24)) == [
        "  frame        Hz    age",
        "  world",
        "> |turtle1   62.6  0.0 s",
        "  |`carrot1       static",
        " *`turtle2   62.6  0.0 s",
    ]


def test_with_room_the_tree_says_who_sends():
    lines = words(tree(TREE, width=70))

    assert lines[0].endswith("age  from")
    assert lines[3].endswith("static  carrot")


def test_several_trees_stand_one_under_the_other():
    shown = moment(WORLD, info("a", "world"), info("map", None, root="map"), info("b", "map"))

    assert [row.info.frame for row in panels.rows(shown.snapshot)] == ["world", "a", "map", "b"]


def test_frames_in_a_loop_are_listed_too():
    shown = moment(info("a", "b", root=None), info("b", "a", root=None))

    assert words(tree(shown, width=30))[1:] == [
        "  a                  in a loop",
        "  b                  in a loop",
    ]


def test_a_chain_as_deep_as_can_be_is_listed():
    frames = [WORLD, *(info(f"f{n}", f"f{n - 1}" if n else "world") for n in range(5000))]

    shown = moment(*frames)

    assert len(panels.rows(shown.snapshot)) == 5001
    assert all(cell_len(line.plain) <= 34 for line in tree(shown, "f4999"))


@pytest.mark.parametrize("cursor", ["f0", "f50", "f99", "nobody"])
def test_the_cursor_stays_in_view(cursor):
    shown = moment(WORLD, *(info(f"f{n}", "world") for n in range(100)))

    lines = words(tree(shown, cursor, height=8))

    assert len(lines) == 8
    assert any(line.startswith("▸") for line in lines) is (cursor != "nobody")


@pytest.mark.parametrize(
    ("age", "shown"),
    [(0.0, "0.0 s"), (6.0, "6 s ago"), (15.5, "15 s ago"), (5000.0, "5000 s ago")],
)
def test_an_old_link_says_so(age, shown):
    lines = tree(moment(WORLD, info("a", "world"), ages={"a": age}))

    assert words(lines)[2].endswith(" " + shown)


def test_an_old_link_turns_amber_and_then_red():
    def inks(age):
        lines = tree(moment(WORLD, info("a", "world"), ages={"a": age}))
        return {span.style.color.triplet.hex for span in lines[2].spans if span.style.color}

    amber, red = (theme.hexadecimal(one) for one in (theme.DARK.warning, theme.DARK.error))
    assert theme.hexadecimal(theme.DARK.text) in inks(0.0)
    assert amber in inks(10.0)
    assert red in inks(19.9)
    # After a second without messages, only the rate is amber.
    assert not {amber, red} & inks(0.9)


def test_a_rate_of_one_sample_is_none():
    lines = words(tree(moment(WORLD, info("a", "world", samples=1, rate=10000.0))))

    assert "–" in lines[2]


@pytest.mark.parametrize(("age", "color"), [(2.0, "warning"), (9.0, "warning"), (20.0, "error")])
def test_a_silent_frame_has_rate_zero_in_amber_or_red(age, color):
    look = Look(theme.DARK)
    line = tree(moment(WORLD, info("a", "world"), ages={"a": age}), look=look)[2]

    assert "62.6" not in line.plain
    at = line.plain.index(" 0.0")
    (style,) = [one.style for one in line.spans if one.start <= at < one.end]
    assert style.color.triplet.hex == theme.hexadecimal(getattr(theme.DARK, color))


def test_a_picture_alone_offers_no_key_for_the_next_panel():
    def offered(alone):
        found = panels.hints("field", drives=True, past=False, ascii_only=False, alone=alone)
        return "Tab" in [hint.keys for hint in found]

    assert offered(alone=False)
    assert not offered(alone=True)


def test_without_frames_there_is_a_sentence():
    assert words(tree(moment())) == ["No frames yet."]


@pytest.mark.parametrize("name", NASTY)
@pytest.mark.parametrize("width", [1, 12, 24, 60])
def test_no_name_breaks_a_panel(name, width):
    found = TransformStamped(1, name, name, Transform((1.0, 2.0, 3.0)))
    shown = moment(
        WORLD,
        info(name, "world", authority=name),
        pair=Pair(name, name, found),
    )
    journal = Journal([LogRecord(seconds(1001), "WARN", name, name)])

    lines = [
        *(tree(shown, name, width=width) if width > 20 else []),
        *panels.pair(shown, width, 20, PLAIN),
        *(journal.lines(seconds(1010), 0, width, 5, PLAIN) if width > 20 else []),
        panels.header(name, shown, 1.0, width, PLAIN) if width > 24 else None,
    ]

    for line in filter(None, lines):
        assert line.plain.isprintable()
        assert "\n" not in line.plain
        assert cell_len(line.plain) <= max(width, 6)


def found(x=3.0, y=4.0, yaw=0.0, stamp=seconds(1009.5)):
    pose = Transform((x, y, 0.0), (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)))
    return TransformStamped(stamp, "turtle2", "turtle1", pose)


def echo(sample, width=40, height=6, look=PLAIN):
    return words(panels.pair(moment(pair=Pair("turtle2", "turtle1", sample)), width, height, look))


def test_a_pair_is_told_in_numbers_and_words():
    assert echo(found(yaw=math.pi / 2)) == [
        "turtle1 in turtle2",
        "at    9.500 s",
        "xyz     3.000   4.000   0.000",
        "quat    0.000   0.000   0.707   0.707",
        "rpy       0.0     0.0    90.0°",
        "away  5.000 m, 53.1° left",
    ]


def test_a_pair_whose_leader_is_lost_is_dim_and_has_an_age():
    lost = moment(
        WORLD,
        info("turtle1", "world"),
        info("turtle2", "world"),
        ages={"turtle1": 9.04, "turtle2": 0.01},
        pair=Pair("turtle2", "turtle1", found(stamp=seconds(1001.0))),
    )
    lines = panels.pair(lost, 40, 6, PLAIN)

    assert lines[1].plain == "at    1.000 s, 9 s old"
    dim = theme.hexadecimal(theme.DARK.dim)
    assert {str(span.style) for line in lines[2:] for span in line.spans} == {dim}


def test_a_pair_in_a_narrow_panel_is_told_shorter():
    assert echo(found(-3.0, -4.0), width=26, look=ASCII) == [
        "turtle1 in turtle2",
        "at 9.500 s",
        "p   -3.00  -4.00   0.00",
        "q   0.00  0.00  0.00  1.00",
        "r     0.0    0.0    0.0",
        "   5.000 m, 126.9d right",
    ]


@pytest.mark.parametrize("width", [26, 40, 60])
def test_numbers_stand_where_they_stood_when_their_sign_changes(width):
    def places(x, y, yaw):
        lines = echo(found(x, y, yaw), width=width, height=12)[1:5]
        return [[at for at, sign in enumerate(line) if sign == "."] for line in lines]

    assert places(3.0, 4.0, 0.5) == places(-3.0, -4.0, -0.5) == places(-12.0, 4.0, 3.0)


def test_with_room_a_pair_is_told_in_every_notation():
    lines = echo(found(yaw=math.pi / 2), width=62, height=12)

    assert lines[6:] == [
        "rad     0.000   0.000   1.571",
        "mat     0.000  -1.000   0.000   3.000",
        "        1.000   0.000   0.000   4.000",
        "        0.000   0.000   1.000   0.000",
        "        0.000   0.000   0.000   1.000",
    ]


@pytest.mark.parametrize(
    ("x", "y", "said"),
    [(2.0, 0.0, "2.000 m, ahead"), (0.0, -2.0, "2.000 m, 90.0° right"), (0.0, 0.0, "0.000 m")],
)
def test_where_the_source_is_in_words(x, y, said):
    assert f"away  {said}" in echo(found(x, y, stamp=0))
    assert "at    all times" in echo(found(x, y, stamp=0))


def test_a_frame_straight_up_or_down_is_not_called_ahead():
    def away(z):
        pose = Transform((0.0, 0.0, z))
        return echo(TransformStamped(0, "a", "b", pose))[-1]

    assert (away(3.0), away(-2.0)) == ("away  3.000 m, above", "away  2.000 m, below")


def test_nothing_is_never_less_than_nothing():
    assert "xyz     0.000   0.000   0.000" in echo(found(-0.0001, -0.0))


def test_a_refusal_is_told_in_full():
    pair = Pair("turtle2", "turtle1", refusal='"turtle2" passed to lookupTransform does not exist.')

    lines = words(panels.pair(moment(pair=pair), 24, 8, PLAIN))

    assert " ".join(lines[1:]) == pair.refusal
    assert len(lines) > 2


def record(second, text, level="INFO", node="sim"):
    return LogRecord(seconds(1000 + second), level, node, text)


def log(journal, until=60, width=40, height=5, look=PLAIN, back=0):
    return words(
        journal.lines(seconds(1000 + until), seconds(1000), width, height, look, back=back)
    )


def test_a_log_record_from_before_the_beginning_shows_no_time():
    # The screen follows a recording's clock, which is years away.
    assert log(Journal([record(-399_099_416, "line")])) == ["     - sim: line"]


def test_the_log_shows_the_newest_lines_with_their_time():
    journal = Journal([record(n, f"line {n}") for n in range(10)])

    assert log(journal, height=2) == ["   8.0 sim: line 8", "   9.0 sim: line 9"]
    assert log(journal, height=2, back=3) == ["   5.0 sim: line 5", "   6.0 sim: line 6"]
    assert log(journal, height=2, back=99) == ["   0.0 sim: line 0"]


def test_a_warning_that_repeats_is_one_line_with_a_count():
    journal = Journal(
        record(n, f"Oh no! I hit the wall! (Clamping from [x={n}.5])", "WARN") for n in range(63)
    )

    lines = log(journal, until=99, width=70)

    assert lines == ["  62.0 sim: Oh no! I hit the wall! (Clamping from [x=62.5]) ×63"]
    assert log(journal, until=99, width=60, look=ASCII)[0].endswith("x63")


def test_fatal_records_are_as_red_as_errors_and_repeats_are_one_line_with_a_count():
    lines = Journal([record(n, f"engine {n} is gone", "FATAL") for n in range(3)]).lines(
        seconds(1060), seconds(1000), 40, 5, PLAIN
    )

    assert words(lines) == ["   2.0 sim: engine 2 is gone ×3"]
    assert PLAIN.ink(PLAIN.palette.error) in [span.style for span in lines[0].spans]


def test_the_log_is_in_order_when_a_line_of_before_is_said_again():
    journal = Journal([record(1, "hit"), record(2, "spawned"), record(3, "hit")])

    assert log(journal) == ["   2.0 sim: spawned", "   3.0 sim: hit ×2"]
    assert log(journal, until=2) == ["   1.0 sim: hit", "   2.0 sim: spawned"]


def test_the_strip_is_the_newest_line_and_says_how_to_see_more():
    journal = Journal([record(1, "early"), record(5, "late " * 20)])

    def strip(until, most=3):
        now, start = seconds(1000 + until), seconds(1000)
        return [line.plain for line in journal.strip(now, start, 40, PLAIN, most=most)]

    assert strip(3) == [f" 1.0 sim: early{'':17}  L log "]
    assert strip(9)[0] == " 5.0 sim: late late late late     L log "
    line = "   late late late late late late late"
    assert strip(9)[1:] == [line, f"{line}…"]
    assert strip(9, most=1) == [" 5.0 sim: late late late late…    L log "]
    assert strip(0)[0].startswith(" Log messages appear here.")


def test_a_refused_lookup_is_read_to_its_end_on_80_columns():
    told = (
        "Could not transform turtle2 to turtle1: Lookup would require extrapolation into the past. "
        " Requested time 1795693068.823222 but the earliest data is at time 1795693072.661122, "
        "when looking up transform from frame [turtle1] to frame [turtle2]"
    )
    journal = Journal([LogRecord(seconds(1000 + n), "WARN", "follower", told) for n in range(5)])

    lines = journal.strip(seconds(1009), seconds(1000), 80, PLAIN)

    text = "\n".join(line.plain for line in lines)
    assert "[turtle2] ×5" in " ".join(text.split())
    assert "…" not in text
    assert max(line.cell_len for line in lines) <= 80


def test_the_scenarios_are_listed_round_the_cursor():
    offered = [(f"s{n}", f"about {n}") for n in range(9)]

    lines = words(panels.scenarios(offered, 6, 20, 3, PLAIN))

    assert lines == ["  s5  about 5", "▸ s6  about 6", "  s7  about 7"]


def test_below_the_scenarios_is_the_whole_description_of_the_chosen_one():
    offered = [("near", "short"), ("far", "a robot drives far away and comes back at night")]
    height = len(offered) + panels.description_lines(offered, 30)

    lines = words(panels.scenarios(offered, 1, 30, height + 2, PLAIN))

    assert " ".join(" ".join(lines[3:]).split()) == offered[1][1]
    assert panels.description_lines(offered, 80) == 0
    assert len(panels.scenarios(offered, 1, 80, 9, PLAIN)) == 2


def test_two_turtles_that_spawn_are_two_lines():
    journal = Journal(
        [record(0, "Spawning turtle [turtle1]"), record(1, "Spawning turtle [turtle2]")]
    )

    assert len(log(journal)) == 2


def test_the_log_of_an_earlier_moment_ends_there():
    journal = Journal([record(1, "early"), record(5, "late")])

    assert log(journal, until=3) == ["   1.0 sim: early"]
    assert log(journal, until=0) == ["Log messages appear here."]


def test_a_long_line_is_broken_at_blanks_and_cut_after_four():
    journal = Journal([record(0, "word " * 60)])

    assert log(journal, width=30, height=9) == [
        "0.0 sim: word word word word",
        "  word word word word word",
        "  word word word word word",
        "  word word word word word…",
    ]


def header(width=40, rate=1.0, behind=0, look=PLAIN):
    return panels.header("tftool demo", moment(behind=behind), rate, width, look).plain


def test_the_top_line_says_what_time_it_is():
    assert header() == " tftool demo             10.0 s  ● live "
    assert header(rate=2.0).endswith("10.0 s  ● live ×2 ")
    assert header(behind=seconds(2.5)).endswith("10.0 s  ◀◀ 2.5 s ago ")
    assert header(rate=math.inf, look=ASCII).endswith("10.0 s  * live ")


def test_the_key_help_shows_what_fits_and_always_how_to_quit():
    hints = [Hint("a", "one"), Hint("b", "very very long"), Hint("c", "two"), Hint("q", "quit")]

    assert panels.footer(hints, 80, PLAIN).plain == " a one  b very very long  c two  q quit"
    assert panels.footer(hints, 24, PLAIN).plain == " a one  c two  q quit"
    assert panels.footer(hints, 5, PLAIN).plain == " q quit"


def test_names_are_darker_on_a_light_panel():
    light = Look(theme.LIGHT).of_name("turtle1")

    assert light.g < PLAIN.of_name("turtle1").g


def test_a_word_wider_than_the_panel_is_cut_into_pieces():
    assert words(wrapped("ab🐢🐢cd", 3)) == ["ab", "🐢", "🐢c", "d"]
    assert words(wrapped("🐢", 1)) == ["🐢", ""]


REFUSED = (
    "Could not transform turtle2 to turtle1: Lookup would require extrapolation into the past.  "
    "Requested time {}.250000 but the earliest data is at time {}.500000"
)


def test_a_refusal_repeated_with_other_stamps_is_one_line_in_seconds_since_the_start():
    journal = Journal([record(n, REFUSED.format(1000 + n, 1002 + n)) for n in range(5)])

    lines = log(journal, width=90)

    text = " ".join(" ".join(lines).split())
    assert "Requested time 4.25 s but the earliest data is at time 6.50 s ×5" in text
    far = log(Journal([record(1, REFUSED.format(1750000000, 5))]), width=90)
    assert "1750000000.250000" in "".join(far)


def test_a_strip_with_room_has_the_line_before_the_newest_above_it():
    journal = Journal([record(1, "early"), record(5, "late")])

    lines = journal.strip(seconds(1009), seconds(1000), 40, PLAIN, most=2)

    assert [line.plain.split() for line in lines] == [
        ["1.0", "sim:", "early", "L", "log"],
        ["5.0", "sim:", "late"],
    ]
