import pytest


def test_it_spawns_and_follows_with_the_tutorials_words(tftool, simulated):
    result = tftool("follow", "--for", "4")

    assert result.status == 0
    assert result.out == ""
    lines = result.err.split("\n")
    assert lines[0] == "No session is running here: hosting scenario 'turtles'."
    assert "[INFO] [1002.000000000] [turtle_following]: Successfully spawned turtle2" in lines


def test_an_unknown_leader_is_told_in_tf2s_words(tftool, simulated):
    result = tftool("follow", "carrot1", "--for", "3")

    assert result.status == 0
    assert "[turtle_following]: Could not transform turtle2 to carrot1:" in result.err


def test_a_third_turtle_gets_a_broadcaster_of_its_own(tftool, simulated):
    result = tftool("follow", "turtle1", "turtle3", "--for", "5")

    assert "Successfully spawned turtle3" in result.err
    assert "Could not transform" not in result.err


def test_a_scenario_brings_its_own_leader(tftool, simulated):
    result = tftool("follow", "carrot1", "turtle2", "carrot", "--for", "5")

    assert "Successfully spawned turtle2" in result.err
    assert "Could not transform" not in result.err


def test_a_delay_looks_into_the_past_which_is_not_there_at_first(tftool, simulated):
    result = tftool("follow", "--delay", "5", "--for", "8")

    assert "extrapolation into the past" in result.err
    assert result.err.count("Could not transform") < 5


def test_a_delay_beyond_what_is_remembered_is_told_with_what_helps(tftool, simulated):
    sentence = "The buffer keeps 10 s, which is too short to look up turtle1 10 s ago: give "

    assert f"{sentence}--cache-time 11.\n" in tftool("follow", "--delay", "10", "--for", "1").err
    assert (
        "forgotten" not in tftool("follow", "--delay", "10", "--cache-time", "11", "--for", "1").err
    )


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--period", "0"], "0 is not a positive number."),
        (["--delay", "-1"], "-1 is not allowed here: give zero or more."),
        (["--kp-distance", "nan"], "nan is not a finite number."),
        (["--max-speed", "-2"], "-2 is not a positive number."),
        (["turtle1", "turtle1"], "'turtle1' cannot follow itself"),
        (["turtle1", "a turtle"], "a turtle"),
        (["base_link", "bob", "robot"], "scenario 'robot' has no turtle simulator"),
    ],
)
def test_follow_refuses_invalid_arguments_with_status_2(tftool, simulated, words, sentence):
    result = tftool("follow", "--for", "1", *words)

    assert result.status == 2
    assert sentence in result.err
