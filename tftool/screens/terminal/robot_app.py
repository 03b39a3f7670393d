"""Screen of `tftool robot`: a slider for each joint, a link's pose, a 3-D picture."""

from collections.abc import Callable, Sequence
from typing import ClassVar

from rich.cells import cell_len
from rich.text import Text
from textual import events
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Container

from tftool.base.errors import TransformException
from tftool.base.plain_text import count
from tftool.drawing.solids import Solids
from tftool.drawing.space import SpaceFrame, SpacePicture
from tftool.drawing.table_columns import fitted, middle_cut, padded, rest_of_list
from tftool.geometry.conversions import rpy_from_quaternion
from tftool.geometry.rigid import Transform
from tftool.screens.terminal.panel_text import Hint, footer
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.sliders import Slider, Sliders, tip_of
from tftool.screens.terminal.space_panel import (
    ORBIT_BINDINGS,
    SPACE_BINDINGS,
    SPACE_KEYS,
    SpacePanel,
    frames_in_space,
)
from tftool.screens.terminal.text_style import Look, wrapped
from tftool.screens.terminal.world_app import FRAME_CSS, Panel, PanelApp
from tftool.world.world import World

LOOKS_PER_SECOND = 15

LEAST_BAR = 7
"""Width in cells of a slider's bar that is kept by shortening names."""

SMALLEST = (40, 8)
"""Smallest columns and rows of a screen on which something useful can be shown."""

BESIDE = 76
"""Smallest number of columns with the picture beside the joints."""

WITH_LINKS = 9
"""Smallest number of rows of the link's panel that also lists the other links."""

WITH_TABLE = 3
"""Smallest number of rows of the table of links: its heading, a link, the number of others."""

BELOW = 26
"""Smallest number of rows with the picture below the joints."""

KEYS = f"""\
 Up, Down     choose a joint (also k, j)
 Left, Right  slide it between its limits
 , .          the same in small steps
 0-9, Enter   type a position and move there
 z c r        all joints: zero, centre, random
 Z C R        the chosen joint alone

 Tab          pose of another link (Shift+Tab too)

{SPACE_KEYS}
 m            light or dark
 ? or Esc     close these keys
 q            quit
"""


class RobotApp(PanelApp):
    """Screen of `tftool robot`.

    Args:
        world: World with the robot's frames.
        sliders: Sliders of the robot's joints.
        link: Link whose pose is shown; None for the link farthest from the root.
        prefix: Prefix of the names of all links.
        setting: Options of the screen.
        solids: Shapes of the links; None to draw no shapes.
        missing: Sentences on why some shapes are not drawn.
    """

    keys_help = KEYS

    CSS = f"""{FRAME_CSS}
    #space {{ width: 1fr; height: 1fr; display: none; }}
    """
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("up,k", "choose(-1)", show=False, priority=True),
        Binding("down,j", "choose(1)", show=False, priority=True),
        Binding("left", "step(-1)", show=False, priority=True),
        Binding("right", "step(1)", show=False, priority=True),
        Binding("z", "everything('zero')", show=False),
        Binding("c", "everything('centre')", show=False),
        Binding("r", "everything('scatter')", show=False),
        Binding("Z", "one('zero')", show=False),
        Binding("C", "one('centre')", show=False),
        Binding("R", "one('scatter')", show=False),
        Binding("tab", "link(1)", show=False, priority=True),
        Binding("shift+tab", "link(-1)", show=False, priority=True),
        Binding("escape", "cancel", show=False),
        Binding("p", "picture", show=False),
        *SPACE_BINDINGS,
        *ORBIT_BINDINGS,
    ]

    def __init__(
        self,
        world: World,
        sliders: Sliders,
        *,
        link: str | None = None,
        prefix: str = "",
        setting: Setting | None = None,
        solids: Solids | None = None,
        missing: Sequence[str] = (),
    ) -> None:
        super().__init__(world, setting)
        self.sliders = sliders
        self._solids = solids
        self._missing = missing
        self._wants_space = True
        self.prefix = prefix
        self.link = link or tip_of(sliders.robot)
        self._links = list(sliders.robot.links)
        self._first = 0

    # Building

    def compose(self) -> ComposeResult:
        """Create the panels of this screen."""
        yield Panel("header", can_focus=False)
        with Container(id="body"):
            with Container(id="side"):
                yield Panel("joints", "Joints", can_focus=False)
                yield Panel("pose", "Link", can_focus=False)
            yield SpacePanel("space", "Robot", can_focus=False)
        yield Panel("footer", can_focus=False)
        yield Panel("keys", "Keys", can_focus=False)

    def on_mount(self) -> None:
        """Start the regular updates of the screen."""
        self.set_interval(1.0 / LOOKS_PER_SECOND, self.redraw)

    def on_resize(self, event: events.Resize) -> None:
        """Arrange the panels for the new size of the terminal."""
        self._arrange()
        self.call_after_refresh(self.redraw)

    def _arrange(self) -> None:
        """Place the 3-D picture beside the list of joints, or below the list."""
        width, height = self.size
        space = self.query_one("#space", SpacePanel)
        space.in_space = self._wants_space and (width >= BESIDE or height >= BELOW)
        space.display = space.in_space
        is_beside = space.in_space and width >= BESIDE
        self.screen.set_class(space.in_space and not is_beside, "portrait")
        self.query_one("#side").styles.width = (
            max(44, min(76, width * 2 // 5)) if is_beside else "1fr"
        )
        joints = max(1, len(self.sliders.sliders)) + 2
        fits = joints + WITH_LINKS <= height - 2
        self.panel("joints").styles.height = joints if fits else "1fr"
        self.panel("pose").styles.height = "1fr" if fits else 6 if height >= 16 else 4

    # Looking

    def redraw(self) -> None:
        """Draw everything that has changed."""
        self.guarded(self._draw)

    def _draw(self) -> None:
        if not self.is_running or not self.panel("header").is_attached:
            return
        look = self.look
        width, height = self.size
        if width < SMALLEST[0] or height < SMALLEST[1]:
            least = f"{SMALLEST[0]}x{SMALLEST[1]}"
            self.panel("joints").show(
                wrapped(f"This terminal is {width}x{height}; {least} or more is needed.", width - 2)
            )
            return
        robot = self.sliders.robot
        shown = self.sliders.sliders
        title = f" {self.title}: {robot.name}, {count(len(shown), 'moving joint')}"
        strong = look.ink(look.palette.text, bold=True)
        self.panel("header").show([Text(padded(title, width, more=look.more), strong)])
        panel = self.panel("joints")
        columns, rows = panel.size
        panel.show(self._sliders(columns, rows) or [Text("This robot has no joint that moves.")])
        self.panel("pose").show(self._pose(*self.panel("pose").size))
        self.panel("footer").show([self._footer(width)])
        self._draw_space()

    def _draw_space(self) -> None:
        space = self.query_one("#space", SpacePanel)
        if not space.in_space:
            return
        root = self.prefix + self.sliders.robot.root
        snapshot = self.world.buffer.snapshot(self.world.clock.now())
        frames = frames_in_space(snapshot, root)
        if len(self._links) == 1:
            # Nobody publishes a transform of a single link.
            frames = (SpaceFrame(root, Transform()),)
        space.draw(SpacePicture(root, frames, self._solids, chosen=self._chosen_frame()), self.look)
        if self._missing:
            # So short that it is whole in a panel of 32 cells.
            space.border_subtitle = f"simpler: {len(self._missing)} meshes not found"

    def _chosen_frame(self) -> str:
        """Return the frame that the chosen joint moves; without a joint, the shown link."""
        joint = self.sliders.chosen
        return self.prefix + (self.link if joint is None else joint.child)

    def _sliders(self, columns: int, rows: int) -> list[Text]:
        """Return a line for each joint near the chosen joint, as many as fit.

        If some joints do not fit, the last line has their number.
        """
        shown = self.sliders.sliders
        if len(shown) > rows > 2:
            # The last line says how many joints are not shown.
            rows -= 1
        place = next((n for n, one in enumerate(shown) if one.is_chosen), 0)
        # Before the first layout there are no rows, and after a resize there may be more.
        most = max(0, len(shown) - rows)
        self._first = min(most, max(min(self._first, place), place - rows + 1, 0))
        lines = self._rows(shown[self._first : self._first + rows], columns)
        above, below = self._first, len(shown) - self._first - len(lines)
        if rest := rest_of_list(below, above, ascii_only=self.look.ascii_only):
            lines.append(Text(rest, self.look.ink(self.look.palette.accent, bold=True)))
        return lines

    def _rows(self, shown: Sequence[Slider], width: int) -> list[Text]:
        look = self.look
        names = max((len(one.joint.name) for one in shown), default=0)
        limits = width >= 72
        room = width - (35 if limits else 15)
        # Names are cut only if the bar would become too short.
        name_width = min(names, max(10, room - LEAST_BAR))
        return [self._row(one, name_width, room - name_width, limits, look) for one in shown]

    def _row(self, one: Slider, name_width: int, bar_width: int, limits: bool, look: Look) -> Text:
        palette = look.palette
        mark = (">" if look.ascii_only else "▸") if one.is_chosen else " "
        ink = look.ink(palette.accent if one.is_chosen else palette.text, bold=one.is_chosen)
        weak = look.ink(palette.dim)
        name = padded(middle_cut(one.joint.name, name_width, more=look.more), name_width)
        if one.is_chosen and self.sliders.entry:
            value = f"{self.sliders.entry}_"
        else:
            value = "?" if one.position is None else f"{one.position:z.4f}"
        line = Text.assemble((f"{mark} {name} ", weak if one.follows else ink))
        line.append(_bar(one, bar_width, look), weak if one.follows else ink)
        line.append(f" {value:>7} {one.joint.unit:<3}", weak if one.follows else ink)
        if limits:
            lower, upper = one.range
            dots = ".." if look.ascii_only else "…"
            text = (
                f"  follows {one.joint.mimic.joint}"
                if one.follows and one.joint.mimic is not None
                else f"  {lower:.3g} {dots} {upper:.3g}"
                if one.joint.limits
                else "  no limits"
            )
            line.append(fitted(text, 20, more=look.more), weak)
        return line

    def _pose(self, width: int, height: int) -> list[Text]:
        look = self.look
        root, link = self.prefix + self.sliders.robot.root, self.prefix + self.link
        heading = Text(
            fitted(f"{link} in {root}", width, more=look.more),
            look.ink(look.palette.text, bold=True),
        )
        try:
            found = self.world.buffer.lookup_transform(root, link)
        except TransformException as error:
            return [heading, *wrapped(str(error), width, look.ink(look.palette.warning))][:height]
        x, y, z = found.transform.translation
        roll, pitch, yaw = rpy_from_quaternion(found.transform.rotation)
        place = f"xyz {x:z.4f} {y:z.4f} {z:z.4f} m"
        turn = f"rpy {roll:z.4f} {pitch:z.4f} {yaw:z.4f} rad"
        if height < 4:
            return [heading, Text(f"{place}   {turn}")]
        lines = [heading, Text(place), Text(turn), self._joint(width)]
        return lines + self._others(width, height - len(lines))

    def _others(self, width: int, height: int) -> list[Text]:
        """Return at most `height` lines: a heading, and the links' positions in the root link."""
        if height < WITH_TABLE:
            return []
        look, root = self.look, self.prefix + self.sliders.robot.root
        name_width = max(8, width - 24)
        lines: list[Text] = []
        chosen = 0
        for link in self._links:
            try:
                place = self.world.buffer.lookup_transform(root, self.prefix + link)
            except TransformException:
                continue
            name = padded(self.prefix + link, name_width, more=look.more)
            numbers = "".join(f"{one:z8.3f}" for one in place.transform.translation)
            color = look.palette.accent if link == self.link else look.of_name(self.prefix + link)
            chosen = len(lines) if link == self.link else chosen
            lines.append(Text.assemble((name, look.ink(color)), numbers))
        head = [Text()] * (height > WITH_TABLE)
        head.append(Text(f"{'':{name_width}}       x       y       z", "dim"))
        height -= len(head)
        if len(lines) > height:
            first = max(0, chosen - height + 2)
            shown = lines[first : first + height - 1]
            lines = [*shown, Text(f"{len(lines) - len(shown)} more", "dim")]
        return head + lines

    def _joint(self, width: int) -> Text:
        """Describe the chosen joint: name, type and limits."""
        joint, look = self.sliders.chosen, self.look
        if joint is None:
            return Text()
        limits = "no limits"
        if joint.limits is not None:
            limits = f"{joint.limits[0]:.3g} to {joint.limits[1]:.3g} {joint.unit}"
        # In a narrow panel, the limits are more important than the type and the whole name.
        words = f": {joint.type}, {limits}"
        if cell_len(joint.name + words) > width:
            words = f": {limits}"
        name = fitted(joint.name, max(1, width - cell_len(words)), more=look.more)
        return Text(fitted(name + words, width, more=look.more), look.ink(look.palette.dim))

    def _footer(self, width: int) -> Text:
        look = self.look
        if self.sliders.refusal:
            words = fitted(f" {self.sliders.refusal}", width, more=look.more)
            return Text(words, look.ink(look.palette.warning))
        turn = [Hint("Shift+arrows", "turn"), Hint("w", "view"), Hint("< >", "zoom")]
        has_picture = self.query_one("#space", SpacePanel).in_space
        end = [Hint("Tab", "link"), *(turn if has_picture else [Hint("p", "picture")])]
        end += [Hint("?", "keys"), Hint("q", "quit")]
        if self.sliders.entry:
            return footer([Hint("Enter", "move there"), Hint("Esc", "cancel"), *end], width, look)
        updown, sides = ("up/down", "left/right") if look.ascii_only else ("↑↓", "←→")
        moves = [] if self.sliders.chosen is None else [Hint(updown, "joint")]
        if moves and self.sliders.can_move:
            moves += [
                Hint(sides, "slide"),
                Hint("0-9", "type"),
                Hint("z c r", "zero, centre, random"),
            ]
        return footer([*moves, *end], width, look)

    # Keys

    def on_key(self, event: events.Key) -> None:
        """Handle a key that types a position, or moves the chosen joint by a small step."""
        sliders, sign = self.sliders, event.character or ""
        if event.key == "enter":
            sliders.enter()
        elif event.key == "backspace":
            sliders.type("\b")
        elif sign == "." and not sliders.entry:
            sliders.step(1, fine=True)
        elif sign == ",":
            sliders.step(-1, fine=True)
        elif sign and (sign in "0123456789-." or (sign == "e" and sliders.entry)):
            sliders.type(sign)
        else:
            return
        self.redraw()

    def action_choose(self, step: int) -> None:
        """Choose the next or previous joint."""
        self.sliders.choose(step)
        self.redraw()

    def action_step(self, direction: int) -> None:
        """Move the chosen joint by a step, in the given direction."""
        self.sliders.step(direction)
        self.redraw()

    def action_cancel(self) -> None:
        """Discard typed digits, and hide the key help."""
        self.panel("keys").display = False
        self.sliders.entry = self.sliders.refusal = ""
        self.redraw()

    def action_everything(self, position: str) -> None:
        """Move all joints: "zero", "centre" (of the limits) or "scatter" (random positions)."""
        self._put(position, all_joints=True)

    def action_one(self, position: str) -> None:
        """Move the chosen joint: "zero", "centre" (of its limits) or "scatter" (at random)."""
        self._put(position, all_joints=False)

    def _put(self, position: str, *, all_joints: bool) -> None:
        moves: dict[str, Callable[..., None]] = {
            "zero": self.sliders.zero,
            "centre": self.sliders.centre,
            "scatter": self.sliders.scatter,
        }
        moves[position](all_joints=all_joints)
        self.redraw()

    def action_picture(self) -> None:
        """Show or hide the robot's 3-D picture."""
        self._wants_space = not self._wants_space
        self._arrange()
        self.call_after_refresh(self.redraw)

    def action_space(self, key: str) -> None:
        """Handle a key of the 3-D picture: orbit, zoom or pan."""
        self.query_one("#space", SpacePanel).press(key, self._chosen_frame())

    def action_link(self, step: int) -> None:
        """Show the pose of the next or previous link."""
        place = self._links.index(self.link) + step
        self.link = self._links[place % len(self._links)]
        self.redraw()


def _bar(slider: Slider, width: int, look: Look) -> str:
    """Draw a joint's slider as text of `width` cells."""
    left, right, track = "[]-" if look.ascii_only else "├┤─"
    room = max(3, width - 2)
    share = slider.share
    if share is None:
        return left + track * room + right
    if look.ascii_only:
        place = round(share * (room - 1))
        return left + track * place + "o" + track * (room - 1 - place) + right
    # The heavy line ends in half cells, so that a small step is visible.
    whole, half = divmod(max(1, round(2 * room * share)), 2)
    return left + "━" * whole + "╾" * half + track * (room - whole - half) + right
