from tftool.base.stamps import seconds
from tftool.buffer.callbacks import FELL_BACK, Watch, must_clear


def watch(least_fall=seconds(1)):
    heard = []
    watching = Watch(
        lambda: heard.append("cleared"),
        lambda level, text: heard.append((level, text)),
        least_fall=least_fall,
    )
    return watching, heard


def test_a_fall_of_a_second_clears_and_says_so():
    watching, heard = watch()

    assert [watching.read(seconds(at)) for at in (5, 9, 8.5, 7.5, 8)] == [
        *(False, False, False, True, False),
    ]
    assert heard == [("WARN", FELL_BACK), "cleared"]


def test_the_first_reading_is_no_jump_and_a_watch_needs_no_log():
    cleared = []
    watching = Watch(lambda: cleared.append(1))

    assert not watching.read(seconds(5))
    assert watching.read(0)
    assert cleared == [1]


def test_another_source_of_time_always_clears():
    assert must_clear(seconds(5), source_changed=True)
    assert not must_clear(seconds(5))
