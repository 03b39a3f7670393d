"""What the keys of the terminal app do, in words."""

from collections.abc import Sequence

from tftool.screens.terminal.panel_text import Hint

DRIVING = """\
 Arrow keys   drive turtle1; a press lasts a second
 g t r e      turn to 0, 45, 90, 135 degrees
 d c v b      turn to 180, -135, -90, -45 degrees
 f            give the turn up

"""

LOOKING = """\
 Tab          next panel (Shift+Tab: back)
 Up, Down     in the tree: pick a frame (also j, k)
 Enter        measure from the frame picked
 x            swap the two frames
 F            draw the picture in the frame picked (again: in the root)

 + - 0        nearer, farther, all there is (also the wheel)
 Shift+Arrow  move the picture (or drag it)

 [ ]          back and on in time by 0.1 s
 { }          by a second
 l            back to live

 L            open the log, or close it (Esc closes it too)
"""

CHOOSING = """\
 o            another scenario
"""

LEAVING = """\
 m            light or dark
 ? or Esc     close these keys
 q            quit
"""


def told(*, drives: bool, chooses: bool) -> str:
    """Say what every key does, a line each; none that does nothing here.

    Args:
        drives: Whether something can be driven.
        chooses: Whether another scenario can be chosen.
    """
    return f"{DRIVING if drives else ''}{LOOKING}{CHOOSING if chooses else ''}{LEAVING}"


def hints(
    panel: str, *, drives: bool, past: bool, ascii_only: bool, chooses: bool = False
) -> Sequence[Hint]:
    """List the keys that matter now, in the order in which a narrow line keeps them.

    Args:
        panel: The panel that has the keys.
        drives: Whether something can be driven.
        past: Whether an earlier moment is shown.
        ascii_only: Whether keys are written in ASCII.
        chooses: Whether another scenario can be chosen.
    """
    arrows, updown = ("arrows", "up/down") if ascii_only else ("↑↓←→", "↑↓")
    travel = [Hint("l", "live"), Hint("[ ]", "time")] if past else [Hint("[ ]", "past")]
    always = [*travel, Hint("Tab", "panel"), Hint("?", "keys")]
    if panel == "scenarios":
        return [
            Hint(updown, "choose"),
            Hint("Enter", "show it"),
            Hint("Esc", "back"),
            Hint("q", "quit"),
        ]
    end = Hint("q", "quit")
    if panel == "tree":
        pick = [Hint(updown, "pick"), Hint("Enter", "measure from"), Hint("x", "swap")]
        return [*pick, *always, end]
    if panel == "pair":
        return [Hint(updown, "source"), Hint("x", "swap"), *always, end]
    if panel == "log":
        return [Hint(updown, "scroll"), *always, end]
    look = [Hint("F", "fix frame"), Hint("+ - 0", "zoom")]
    other = [Hint("o", "scenarios")] if chooses else []
    if not drives:
        return [*always, *look, *other, end]
    turn = [Hint("gbvcdert", "turn, f cancel")]
    return [Hint(arrows, "drive"), *always, *look, *other, *turn, end]
