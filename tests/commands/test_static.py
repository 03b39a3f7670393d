import math

import pytest

from tftool.base.errors import UsageError
from tftool.geometry.notation.static_arguments import parse

words = str.split
FRAMES = ["--frame-id", "a", "--child-frame-id", "b"]


@pytest.mark.parametrize(
    ("given", "text", "remedy"),
    [
        ([], "Frame id must not be empty", "--frame-id PARENT"),
        (["--frame-id", "a"], "Child frame id must not be empty", "--child-frame-id CHILD"),
        (
            ["--qx", "1", "--roll", "1", *FRAMES],
            "Cannot specify both quaternion and Euler rotations",
            "--roll and --qx",
        ),
        (
            ["--yaw", "1", *words("0 0 3 0 0 3.14 A B")],
            "Cannot specify both new-style (flags) and old-style (arguments)",
            "Leave out --yaw",
        ),
        (["--x"], "Not enough arguments for --x", "next word"),
        (["--x", "3.14abc", *FRAMES], "Failed to parse --x argument as float", "'3.14abc'"),
        (["--x", "nan", *FRAMES], "Failed to parse --x argument as float", "'nan'"),
        (["--x", "1e999", *FRAMES], "Failed to parse --x argument as float", "'1e999'"),
        (["--x", "1_000", *FRAMES], "Failed to parse --x argument as float", "'1_000'"),
        (["--x", "٣", *FRAMES], "Failed to parse --x argument as float", "'٣'"),
        (words("0 0 0 0 0 k A B"), "Failed to parse roll argument as float", "'k'"),
        (words("0 0 0 k 0 0 A B"), "Failed to parse yaw argument as float", "'k'"),
        (
            words("0 0 0 0 0 0 k A B"),
            "Failed to parse qw argument as float",
            "'k'",
        ),
        (
            words("1 2 3 4 5 A B"),
            "Extra unparsed arguments on command-line",
            "not 7",
        ),
        (["--x=1", *FRAMES], "Extra unparsed arguments on command-line", "Write --x 1"),
        (["--frame_id", "a"], "Extra unparsed arguments", "Did you mean --frame-id?"),
        (["--zzzzzz", "a"], "Extra unparsed arguments", "There is no --zzzzzz."),
        (
            ["0", "0", "0", "0", "0", "0", "", "B"],
            "Frame id must not be empty",
            "before the child frame",
        ),
        (["0", "0", "0", "0", "0", "0", "A", ""], "Child frame id must not be empty", "last"),
    ],
)
def test_every_mistake_has_tf2s_text_and_a_remedy(given, text, remedy):
    with pytest.raises(UsageError) as refused:
        parse(given)

    assert str(refused.value).startswith(f"error parsing command line arguments: {text}")
    assert remedy in str(refused.value)


def test_the_old_order_is_yaw_pitch_roll():
    said = parse(words("1 2 3 0.1 0.2 0.3 a b"))

    assert said.old_style
    assert said.angles == (0.3, 0.2, 0.1)
    assert said.transform.translation == (1.0, 2.0, 3.0)
    assert said.transform.rotation == pytest.approx(
        (0.14357217502739192, 0.10602051106179562, 0.03427079855048211, 0.9833474432563559)
    )


def test_options_come_in_any_order_and_the_later_one_wins():
    said = parse(words("--child-frame-id b --z 7 --frame-id a --z -1.5e-1"))

    assert (said.parent, said.child) == ("a", "b")
    assert said.transform.translation == (0.0, 0.0, -0.15)
    assert not said.old_style


def test_a_quaternion_is_passed_on_as_it_is():
    assert parse(words("0 0 0 0 0 0.5 0.8 a b")).transform.rotation == (
        0.0,
        0.0,
        0.5,
        0.8,
    )
    assert parse(["--qx", "0.5", *FRAMES]).transform.rotation == (0.5, 0.0, 0.0, 1.0)


@pytest.mark.parametrize("word", ["--help", "-h"])
def test_parse_returns_none_for_a_help_option_after_other_arguments(word):
    assert parse(["1", "2", word]) is None


def test_the_tutorials_example_is_said_in_words(tftool):
    result = tftool("static", "--once", *words("0 0 3 0 0 3.14 A B"))

    assert result.status == 0
    assert result.out.split("\n") == [
        "translation: ('0.000000', '0.000000', '3.000000')",
        "rotation: ('1.000000', '0.000000', '0.000000', '0.000796')",
        "from 'A' to 'B'",
        "B in A: 3 m along z, turned 179.909° about its x axis.",
        "",
    ]
    assert result.err.split("\n") == [
        "Old-style arguments are deprecated; see --help for new-style arguments.",
        "The sixth number is roll: 3.14 turns about the x axis. To turn about z, "
        "write the angle as the fourth number: 0 0 3 3.14 0 0 A B",
        "",
    ]


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        (FRAMES, "b in a: at the same place, not turned."),
        (["--yaw", "-1.5707963267948966", *FRAMES], "turned -90.000° about its z axis."),
        (["--x", "1", "--y", "-2.5", *FRAMES], "1 m along x and -2.5 m along y, not turned."),
        (
            ["--qx", ".5", "--qy", ".5", "--qz", ".5", "--qw", ".5", *FRAMES],
            "turned 120.000° about the axis (0.577, 0.577, 0.577).",
        ),
    ],
)
def test_axis_and_degrees_are_said(tftool, given, sentence):
    assert tftool("static", "--once", *given).out.rstrip("\n").endswith(sentence)


def test_degrees_in_place_of_radians_are_noticed(tftool):
    result = tftool("static", "--once", "--yaw", "90", *FRAMES)

    assert result.status == 0
    assert result.err == (
        "Angles are radians, and 90 is more than a full turn; "
        f"90 degrees would be {math.pi / 2:.6g}.\n"
    )


def test_a_quaternion_of_another_length_is_noticed(tftool):
    result = tftool("static", "--once", *words("0 0 0 0 0 0 2 a b"))

    assert "length 2, not 1" in result.err


def test_negative_numbers_are_numbers_and_an_equals_sign_may_join(tftool):
    assert (
        "-1 m along x and -2 m along y"
        in tftool("static", "--once", *words("-1 -2 0 0 0 0 A B")).out
    )
    assert "-1.5 m along x" in tftool("static", "--once", "--x=-1.5", *FRAMES).out


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        (words("0 0 3 0 0 3.14 A"), "Extra unparsed arguments on command-line"),
        (
            words("0 0 3 0 0 3.14 A A"),
            "cannot publish static transform from 'A' to 'A'",
        ),
        (words("0 0 3 0 0 3.14 /A A"), "TF_SELF_TRANSFORM"),
        (words("0 0 3 0 0 0 0 A B"), "four zeros is not a rotation: write 0 0 0 1 for no turn."),
        (["--qw", "0", *FRAMES], "four zeros is not a rotation: write 0 0 0 1 for no turn."),
        (["--read-only", *FRAMES], "--read-only publishes nothing"),
        (["--frame-di", "a"], "Did you mean --frame-id?"),
        (["--yaw"], "--yaw"),
    ],
)
def test_static_refuses_invalid_arguments_in_one_line_with_status_2(tftool, given, sentence):
    result = tftool("static", "--once", *given)

    assert result.status == 2
    assert result.out == ""
    assert sentence in result.err
    assert result.err.count("\n") == 1


def test_names_that_look_like_markup_stay_names(tftool):
    result = tftool("static", "--once", "--frame-id", "[bold]", "--child-frame-id", "a b\x1b[0m")

    assert result.status == 0
    assert "from '[bold]' to 'a b␛[0m'\n" in result.out
