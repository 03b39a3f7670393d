"""Tests of the part of the picture that the turtles' screen shows."""

from tests.screens.visiting import screen, settled, shown, visit
from tftool.screens.terminal.world_app import input_events


def test_the_picture_is_drawn_in_the_frame_that_is_chosen(danced):
    pressed = []

    chosen = "\n".join(shown(danced, keys=("F",), press=pressed.append))
    other = "\n".join(shown(danced, keys=("j", "F"), press=pressed.append))
    back = "\n".join(shown(danced, keys=("F", "F"), press=pressed.append))

    assert "Frames in turtle1 (fixed)" in chosen
    assert "Frames in turtle2 (fixed)" in other
    assert "Frames in world ─" in back
    assert pressed == []


def scale_of(lines):
    """Return the metres below the picture, and those at its left."""
    below = next(line for line in lines if line.startswith("│ m"))
    return [float(one) for one in below.split("│")[1].split()[1:]]


def test_one_zooms_in_and_out_and_back_to_all_there_is(danced):
    plain = shown(danced)
    near = scale_of(shown(danced, keys=("plus", "plus", "plus")))
    far = scale_of(shown(danced, keys=("minus", "minus", "minus")))
    whole = scale_of(plain)

    assert near[-1] - near[0] < whole[-1] - whole[0] < far[-1] - far[0]
    assert scale_of(shown(danced, keys=("plus", "shift+left", "minus", "0"))) == whole


def test_the_picture_is_moved(danced):
    pressed = []
    keys = ("plus", "plus", "plus")
    here = scale_of(shown(danced, keys=keys))
    left = scale_of(shown(danced, keys=(*keys, "shift+left"), press=pressed.append))

    assert left[0] < here[0]
    assert pressed == []


def mouse(app, *sent):
    """Pass the codes that a terminal sends for its mouse (SGR), as bytes."""
    for code in sent:
        for event in input_events(f"\x1b[<{code}"):
            app.post_message(event)


def test_the_wheel_zooms_where_the_pointer_is_and_dragging_moves(danced):
    async def steps(app, pilot):
        whole = scale_of(screen(app))
        mouse(app, "64;20;10M", "64;20;10M", "64;20;10M")
        await settled(pilot)
        near = scale_of(screen(app))
        assert near[-1] - near[0] < whole[-1] - whole[0]
        mouse(app, "0;20;10M", "32;35;10M", "0;35;10m")
        await settled(pilot)
        assert scale_of(screen(app))[0] < near[0]
        mouse(app, *["65;20;10M"] * 6)
        await settled(pilot)
        assert scale_of(screen(app))[-1] > near[-1]

    visit(danced, (100, 30), steps)


def test_a_click_picks_the_frame_under_it(danced):
    async def steps(app, pilot):
        lines = screen(app)
        row = next(row for row, line in enumerate(lines) if "├─ turtle1" in line)
        column = lines[row].index("├─ turtle1") + 5
        # The row above belongs to world; a terminal counts from 1.
        mouse(app, f"0;{column};{row}M", f"0;{column};{row}m")
        await settled(pilot)
        assert "world in turtle2" in "\n".join(screen(app))
        mouse(app, f"0;{column};{row + 1}M", f"0;{column};{row + 1}m")
        await settled(pilot)
        assert "turtle1 in turtle2" in "\n".join(screen(app))

    visit(danced, (100, 30), steps)
