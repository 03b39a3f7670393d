"""Terminal app of demo and teleop: field, tree, a pair of frames, log; keys drive a turtle.

The screen observes a world, and changes the world only by keys passed to `press`. The screen shows
the world's time. The number of pictures per real second is fixed, also if simulated time runs
faster or slower.
"""

import asyncio
import math
from collections.abc import Callable, Sequence
from typing import ClassVar

from textual import events
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Container
from textual.content import Content

from tftool.base.errors import TftoolError
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.screens.terminal import panel_text as keys
from tftool.screens.terminal import panel_text as panels
from tftool.screens.terminal.log_lines import Journal
from tftool.screens.terminal.panel_text import PairPlot
from tftool.screens.terminal.plane_view import PlaneView
from tftool.screens.terminal.question import SceneQuestion
from tftool.screens.terminal.scene import Scene, SceneMoment
from tftool.screens.terminal.screen_options import SMALLEST, Setting, arranged
from tftool.screens.terminal.space_panel import (
    SPACE_BINDINGS,
    SpacePanel,
    opens_in_space,
    space_picture,
)
from tftool.screens.terminal.text_style import wrapped
from tftool.screens.terminal.world_app import FRAME_CSS, Panel, PanelApp
from tftool.world.nodes.turtle_drivers import IdleDrawing

LOOKS_PER_SECOND = 10

WITH_WRAPPED_LOG = 36
"""Smallest number of rows with the newest log message wrapped rather than cut."""

REST = 5.0
"""Pause after a picture, as a multiple of the time that tftool needed to draw the picture. With the
terminal's own drawing (0.4 times this time), the demo still uses less than a quarter of a core."""

STEP, LEAP = seconds(0.1), seconds(1.0)

Press = Callable[[str], object]


class TurtleApp(PanelApp):
    """Screen of `tftool demo` and `tftool teleop`.

    Args:
        scene: Scene to show.
        press: Function called with a key that drives, such as "up"; None if no turtle can be
            driven.
        setting: Options of the screen.
        idle: Node that drives a turtle while no key is pressed; None without such a node.

    Attributes:
        chosen: Scenario that the user has chosen to show next; None if no scenario was chosen.
        press_key: Function called with a key that drives; None if no turtle can be driven.
    """

    CSS = f"""{FRAME_CSS}
    Panel:focus {{ border: round $accent; border-title-color: $accent; border-title-style: bold; }}
    .mono Panel:focus {{ border: heavy $accent; }}
    .ascii Panel:focus {{ border: ascii $accent; }}
    #small {{ border: none; height: 1fr; display: none; background: $background; }}
    #scenarios {{ layer: above; dock: top; display: none; border: round $accent; }}
    .ascii #scenarios {{ border: ascii $accent; }}
    #log {{ border: none; height: 1; background: $background; }}
    #log:focus {{ border: round $accent; background: $surface; }}
    .mono #log:focus {{ border: heavy $accent; }}
    .ascii #log {{ border: none; }}
    .ascii #log:focus {{ border: ascii $accent; }}
    """
    BINDINGS: ClassVar[list[BindingType]] = [
        *(
            Binding(key, f"steer('{key}')", show=False, priority=True)
            for key in ("up", "down", "left", "right")
        ),
        *(
            Binding(f"{key},{key.upper()}", f"drive('{key}')", show=False, priority=True)
            for key in "gtredcvb"
        ),
        Binding("f", "drive('f')", show=False, priority=True),
        Binding("F", "fix", show=False, priority=True),
        Binding("plus,equals_sign", "zoom(1)", show=False, priority=True),
        Binding("minus,underscore", "zoom(-1)", show=False, priority=True),
        Binding("0", "fit", show=False, priority=True),
        *(
            Binding(f"shift+{key}", f"pan({x}, {y})", show=False, priority=True)
            for key, x, y in (("left", 6, 0), ("right", -6, 0), ("up", 0, 3), ("down", 0, -3))
        ),
        Binding("tab", "panel(1)", show=False, priority=True),
        Binding("shift+tab", "panel(-1)", show=False, priority=True),
        Binding("j", "pick(1)", show=False),
        Binding("k", "pick(-1)", show=False),
        Binding("enter,space", "measure", show=False),
        Binding("x", "swap", show=False),
        Binding("p", "picture", show=False),
        *SPACE_BINDINGS,
        Binding("L", "log", show=False),
        Binding("o,O", "scenarios", show=False),
        Binding("left_square_bracket", f"travel({-STEP})", show=False),
        Binding("right_square_bracket", f"travel({STEP})", show=False),
        Binding("left_curly_bracket", f"travel({-LEAP})", show=False),
        Binding("right_curly_bracket", f"travel({LEAP})", show=False),
        Binding("l,escape,end", "live", show=False),
    ]

    def __init__(
        self,
        scene: Scene,
        press: Press | None = None,
        setting: Setting | None = None,
        idle: IdleDrawing | None = None,
    ) -> None:
        super().__init__(scene.world, setting)
        self.scene = scene
        self.chosen: str | None = None
        self.press_key = press
        chooses = self.setting.scenarios is not None
        self.keys_help = keys.key_help(drives=press is not None, chooses=chooses)
        self._idle = idle
        self._offered: Sequence[tuple[str, str]] = ()
        self._offer = 0
        self._question = SceneQuestion(scene, self.setting.pair)
        self._question.at = self.setting.at
        self._stale = True
        self._back = 0
        self._strip = 1
        self._rest_until = 0.0
        self._plane = PlaneView()
        self._is_decided = self.setting.drive_only
        self._plot = PairPlot()
        self._dragged: tuple[int, int] | None = None
        self._pair_height = 0
        self._rows_shown: tuple[str, ...] = ()
        self._journal = Journal(scene.world.log.records)
        scene.world.log.listen(self._journal.add, "screen")

    def begin(self, stamp: Stamp) -> None:
        """Count seconds from `stamp`, the start of the world; for a recording, do nothing."""
        if self.setting.at is None:
            self.scene.start = stamp

    # Building

    def compose(self) -> ComposeResult:
        """Create the panels of this screen; `_arrange` sets the sizes of the panels."""
        yield Panel("header", can_focus=False)
        with Container(id="body"):
            yield SpacePanel("field", "Field")
            with Container(id="side"):
                yield Panel("tree", "Tree")
                yield Panel("pair", "Echo")
                yield Panel("plot", "Plot", can_focus=False)
        yield Panel("log", "Log")
        yield Panel("footer", can_focus=False)
        yield Panel("small", can_focus=False)
        yield Panel("scenarios", "Scenarios", can_focus=False)
        yield Panel("keys", "Keys: ? or Esc closes them", can_focus=False)

    def on_mount(self) -> None:
        """Start the regular updates of the screen."""
        self.screen.set_class(not self.setting.colors, "mono")
        self.panel("field").focus()
        sign = "*" if self.setting.ascii_only else "◎"
        self.panel("tree").border_subtitle = Content(f"{sign} measured from")
        self.set_interval(1.0 / LOOKS_PER_SECOND, self.look_again)

    def on_resize(self, event: events.Resize) -> None:
        """Arrange the panels for the new size of the terminal."""
        self._strip = 2 if event.size.height >= WITH_WRAPPED_LOG else 1
        self._arrange(event.size.width, event.size.height)
        self.call_after_refresh(self.redraw)

    def _arrange(self, width: int, height: int) -> None:
        moment = self._question.moment
        frames = 3 if moment is None else len(moment.snapshot.frames)
        layout = arranged(width, height - self._strip + 1, frames)
        for name in ("header", "footer"):
            self.panel(name).display = not layout.small
        self.panel("small").display = layout.small
        self.query_one("#body").display = not layout.small
        self.query_one("#side").display = not layout.alone
        self.screen.set_class(layout.portrait, "portrait")
        field, tree, pair, plot = (self.panel(name) for name in ("field", "tree", "pair", "plot"))
        field.styles.width = layout.field[0] or "1fr"
        field.styles.height = layout.field[1] or "1fr"
        self._pair_height = layout.pair
        plot.display = True
        for panel, lines in ((tree, layout.tree), (pair, layout.pair), (plot, 0)):
            panel.styles.height = lines or "1fr"
        if self.setting.drive_only:
            self.query_one("#side").display = False
            field.styles.width = field.styles.height = "1fr"
        log = self.panel("log")
        log.display = not layout.small
        log.styles.height = layout.log if log.has_focus else self._strip

    # Looking

    def look_again(self) -> None:
        """Draw the current state, unless the last drawing was slow and has just ended."""
        loop = asyncio.get_running_loop()
        if loop.time() < self._rest_until:
            return
        began = loop.time()
        self.guarded(self._look)
        # A world of thousands of frames is drawn less often, so that its nodes get time to run.
        self._rest_until = loop.time() + REST * (loop.time() - began)

    def _look(self) -> None:
        if self._idle is not None and (self._question.at is not None or self._is_over()):
            # The turtle draws no curve while the user sees the past, the help or the scenarios.
            self._idle.touch()
        self.scene.look()
        self._draw()

    def redraw(self) -> None:
        """Draw the current state again."""
        self._stale = True
        self.guarded(self._draw)

    def _draw(self) -> None:
        if not self.is_running or not self.panel("header").is_attached:
            return
        width, height = self.size
        if self.panel("small").display:
            least = f"{SMALLEST[0]}x{SMALLEST[1]}"
            words = f"This terminal is {width}x{height}; tftool needs {least} or more."
            self.panel("small").show(wrapped(words, width))
            return
        question = self._question
        moment = question.moment
        has_grown = False
        if question.at is None or self._stale or moment is None:
            frames = 0 if moment is None else len(moment.snapshot.frames)
            moment = question.ask()
            has_grown = len(moment.snapshot.frames) != frames
            if has_grown:
                self._arrange(width, height)
                # Not only with the next picture, which may be late on a busy machine.
                self.call_after_refresh(self.redraw)
        else:
            moment = question.wait(moment)
        # The tree's new size is only known after the next update.
        self._stale = has_grown
        # All panels show one moment: never a number beside a picture that has moved on.
        self._draw_field(moment)
        self._draw_panels(moment)

    def _draw_field(self, moment: SceneMoment) -> None:
        field = self.field
        if not self._is_decided and moment.picture.frames:
            field.in_space = opens_in_space(moment)
            # Static frames may arrive first: a frame that moves shows the world from above.
            self._is_decided = not field.in_space
        width, height = field.size
        field.border_title = Content(
            panels.field_title(moment, is_chosen=bool(self._question.fixed))
        )
        told = self._driven() if self.setting.drive_only else ""
        idle = self._idle
        turtles = {frame.name for frame in moment.picture.frames if frame.is_turtle}
        if idle is not None and idle.is_drawing and idle.turtle in turtles:
            told = f"{idle.turtle} draws by itself"
            told += "; a key stops it" if width > len(told) + 22 else ""
        field.border_subtitle = Content(told)
        if field.in_space:
            field.draw(space_picture(moment, self.scene.solids), self.look)
            return
        field.show(
            self._plane.lines(moment.picture, width, height, self.look, colors=self.setting.colors)
        )

    def _driven(self) -> str:
        """Return the pose and the speed of the driven turtle as text."""
        simulator = self.scene.simulator
        turtle = simulator.turtles.get(self.setting.pair[1]) if simulator else None
        if turtle is None:
            return ""
        pose = turtle.pose
        heading = f"{math.degrees(pose.theta):z.0f}{'d' if self.setting.ascii_only else '°'}"
        return f"x {pose.x:.2f}  y {pose.y:.2f}  {heading}  {pose.linear_velocity:z.1f} m/s"

    @property
    def field(self) -> SpacePanel:
        """Panel with the picture of the frames."""
        return self.query_one("#field", SpacePanel)

    def _draw_panels(self, moment: SceneMoment) -> None:
        look, clock = self.look, self.scene.world.clock
        width = self.size.width
        self.panel("header").show([panels.header(self.title, moment, clock.rate, width, look)])
        hints = keys.hints(
            self._keys_go_to(),
            drives=self.press_key is not None,
            past=self._question.at is not None,
            ascii_only=look.ascii_only,
            chooses=self.setting.scenarios is not None,
            in_space=None if self.setting.drive_only else self.field.in_space,
            alone=not self.query_one("#side").display,
        )
        self.panel("footer").show([panels.footer(hints, width, look)])
        self._draw_log(moment)
        if not self.query_one("#side").display:
            return
        tree, pair, plot = (self.panel(name) for name in ("tree", "pair", "plot"))
        listed = panels.rows(moment.snapshot, ascii_only=look.ascii_only)
        shown = panels.in_view(listed, self._question.source, tree.size.height)
        self._rows_shown = tuple(row.info.frame for row in shown)
        tree.show(panels.tree(moment, listed, self._question.source, *tree.size, look))
        told = panels.pair(moment, *pair.size, look)
        is_long = moment.pair.found is None and len(told) > self._pair_height - 2
        if plot.display == is_long:
            # The whole error text is shown instead of the plot, which would be empty.
            plot.display = not is_long
            pair.styles.height = "1fr" if is_long else self._pair_height
        pair.show(told)
        plot.show(self._plot.lines(moment, self.scene, *plot.size, look))

    def _draw_log(self, moment: SceneMoment) -> None:
        """Draw the newest log message, or a whole panel of messages if the log has the focus."""
        log, look = self.panel("log"), self.look
        if log.has_focus:
            lines = self._journal.lines(
                moment.stamp, self.scene.start, *log.size, look, back=self._back
            )
        else:
            lines = self._journal.strip(
                moment.stamp, self.scene.start, log.size.width, look, most=self._strip
            )
        log.show(lines)

    # The mouse

    def on_mouse_scroll_up(self, event: events.MouseScrollUp) -> None:
        """Zoom in at the pointer, or scroll the panel under the pointer up."""
        self._wheel(event, 1)

    def on_mouse_scroll_down(self, event: events.MouseScrollDown) -> None:
        """Zoom out at the pointer, or scroll the panel under the pointer down."""
        self._wheel(event, -1)

    def _wheel(self, event: events.MouseEvent, step: int) -> None:
        name, x, y = self._under(event)
        if name == "field":
            self._plane.camera.zoom(step, self._plane.cell(x, y))
        elif name == "tree":
            self._question.pick(-step)
        elif name == "log":
            self._scroll(step)
        self.redraw()

    def on_mouse_down(self, event: events.MouseDown) -> None:
        """Select the frame under the pointer, or start to drag the picture."""
        name, x, y = self._under(event)
        moment = self._question.moment
        if moment is None:
            return
        if name == "field":
            self._dragged = event.screen_x, event.screen_y
            if self.field.in_space:
                frame = self.field.frame_at(x, y)
            else:
                frame = self._plane.frame_at(moment.picture, x, y)
        elif name == "tree":
            frame = self._rows_shown[y - 1] if 0 < y <= len(self._rows_shown) else None
        else:
            return
        if frame is not None and self._question.choose(frame):
            self.redraw()

    def on_mouse_move(self, event: events.MouseMove) -> None:
        """Move the picture with the pointer while the picture is dragged."""
        if self._dragged is None:
            return
        if not event.button:
            self._dragged = None
            return
        x, y = event.screen_x, event.screen_y
        self._plane.camera.pan(x - self._dragged[0], y - self._dragged[1])
        self._dragged = x, y
        self.redraw()

    def on_mouse_up(self) -> None:
        """Stop dragging the picture."""
        self._dragged = None

    def _under(self, event: events.MouseEvent) -> tuple[str, int, int]:
        """Return the panel under the pointer ("" for none), and the pointer's cell in the panel."""
        for name in ("field", "tree", "pair", "log"):
            panel = self.panel(name)
            inside = panel.content_region
            if panel.display and inside.contains(event.screen_x, event.screen_y):
                return name, event.screen_x - inside.x, event.screen_y - inside.y
        return "", 0, 0

    # Keys

    async def on_event(self, event: events.Event) -> None:
        """Handle an event; a key or mouse button also stops the turtle that drives by itself."""
        if isinstance(event, events.Key | events.MouseDown) and self._idle is not None:
            self._idle.touch()
        await super().on_event(event)

    def _is_over(self) -> bool:
        """Return whether the key help or the list of scenarios covers the picture."""
        return bool(self.panel("keys").display or self.panel("scenarios").display)

    def _keys_go_to(self) -> str:
        if self.panel("scenarios").display:
            return "scenarios"
        return (self.focused.id or "") if self.focused else ""

    def action_drive(self, key: str) -> None:
        """Pass a key to the function that drives the turtle; log an error of the function."""
        if self.press_key is not None:
            try:
                self.press_key(key)
            except TftoolError as refusal:
                self.scene.world.log.warn("screen", str(refusal))

    def action_steer(self, key: str) -> None:
        """Drive with an arrow key, or move the cursor if a text panel has the focus."""
        focused = self._keys_go_to()
        step = {"up": -1, "down": 1}.get(key, 0)
        if focused == "scenarios":
            self._offer = max(0, min(len(self._offered) - 1, self._offer + step))
            self._show_offered()
        elif focused in {"tree", "pair"}:
            if step:
                self.action_pick(step)
        elif focused == "log":
            self._scroll(-step)
            self.redraw()
        else:
            self.action_drive(key)

    def _scroll(self, lines: int) -> None:
        """Scroll the log back by `lines` messages; forward if `lines` is negative."""
        self._back = max(0, min(self._back + lines, len(self.scene.world.log.records)))

    def action_panel(self, step: int) -> None:
        """Focus the next or the previous panel."""
        if step > 0:
            self.screen.focus_next()
        else:
            self.screen.focus_previous()
        self.call_after_refresh(self.redraw)

    def action_log(self) -> None:
        """Open or close the log."""
        log = self.panel("log")
        (self.panel("field") if log.has_focus else log).focus()

    def on_descendant_focus(self) -> None:
        """Arrange the panels when another panel gets the focus; the log is open while focused."""
        self._fit_panels()

    def _fit_panels(self) -> None:
        self._back = 0
        self._arrange(*self.size)
        self.call_after_refresh(self.redraw)

    def action_pick(self, step: int) -> None:
        """Move the cursor in the tree, and make the frame under the cursor the source."""
        if self._question.pick(step):
            self.redraw()

    def action_measure(self) -> None:
        """Make the frame under the cursor the target; in the scenario list, choose the scenario."""
        if self.panel("scenarios").display:
            self.chosen = self._offered[self._offer][0]
            self.exit()
            return
        self._question.measure()
        self.redraw()

    def action_fix(self) -> None:
        """Make the frame under the cursor the fixed frame of the picture.

        If that frame is the fixed frame already, the root of the tree becomes the fixed frame.
        """
        if self.setting.drive_only:
            # In teleop, f has the same meaning in both cases.
            self.action_drive("f")
            return
        self._question.fix()
        self.redraw()

    def action_zoom(self, steps: int) -> None:
        """Zoom in by a number of steps; zoom out if the number is negative."""
        (self.field.camera if self.field.in_space else self._plane.camera).zoom(steps)
        self.redraw()

    def action_pan(self, columns: int, rows: int) -> None:
        """Pan the view from above; in the 3-D view, orbit instead."""
        if self.field.in_space:
            self.field.camera.turn(-columns / 6, rows / 3)
        else:
            self._plane.camera.pan(columns, rows)
        self.redraw()

    def action_picture(self) -> None:
        """Switch between 3-D and the view from above."""
        if not self.setting.drive_only:
            self._is_decided, self.field.in_space = True, not self.field.in_space
            self.redraw()

    def action_space(self, key: str) -> None:
        """Orbit, zoom or pan the 3-D picture."""
        self.field.press(key, self._question.source)

    def action_fit(self) -> None:
        """Undo zooming and panning: show the whole picture."""
        (self.field.camera if self.field.in_space else self._plane.camera).fit()
        self.redraw()

    def action_swap(self) -> None:
        """Exchange the pair's target and source."""
        self._question.swap()
        self.redraw()

    def action_travel(self, step: Duration) -> None:
        """Move the shown time by `step` nanoseconds; at the present, show the live state."""
        self._question.travel(step)
        self.redraw()

    def action_live(self) -> None:
        """Close the help or the list of scenarios; if neither is open, show the present."""
        if self._is_over():
            self.panel("keys").display = self.panel("scenarios").display = False
            self.redraw()
            return
        if self.panel("log").has_focus:
            self.panel("field").focus()
        self._question.at = None
        self._back = 0
        self.redraw()

    def action_scenarios(self) -> None:
        """Show or hide the list of scenarios."""
        if self.setting.scenarios is None:
            return
        panel = self.panel("scenarios")
        panel.display = not panel.display
        self.panel("keys").display = False
        if panel.display:
            self._offered = self._offered or self.setting.scenarios()
            width, height = self.size
            wide, high = self._offered_size()
            panel.styles.width, panel.styles.height = wide, high
            panel.styles.offset = max(0, (width - wide) // 2), max(0, (height - high) // 2)
            self._show_offered()
        self.redraw()

    def _show_offered(self) -> None:
        # Computed from the offered size, because the panel's own is only known after the layout.
        wide, high = self._offered_size()
        lines = panels.scenarios(self._offered, self._offer, wide - 2, high - 2, self.look)
        self.panel("scenarios").show(lines)

    def _offered_size(self) -> tuple[int, int]:
        width, height = self.size
        wide = min(width - 2, 96)
        lines = len(self._offered) + panels.description_lines(self._offered, wide - 2)
        return wide, min(height - 2, lines + 2)
