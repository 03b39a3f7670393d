"""Pair of frames and time that the user selects on a screen."""

from dataclasses import replace

from tftool.base.stamps import Duration, Stamp, seconds
from tftool.screens.terminal import panel_text as panels
from tftool.screens.terminal.scene import Scene, SceneMoment

PATIENCE = seconds(4.0)
"""Nanoseconds to wait for the frames of the first pair before another pair is shown."""


class SceneQuestion:
    """Pair of frames and time that the user selects with keys.

    Args:
        scene: Scene in which the pair is looked up.
        pair: Initial target and source frame.

    Attributes:
        target: Frame in which the pose is expressed.
        source: Frame under the cursor, whose pose is shown.
        at: Time to show; None for the present.
        fixed: Frame in which the picture is drawn; "" for the root of the pair's tree.
        moment: Poses of the last lookup of the scene; None before the first lookup.
    """

    def __init__(self, scene: Scene, pair: tuple[str, str]) -> None:
        self.scene = scene
        self.target, self.source = self._wished = pair
        self.at: Stamp | None = None
        self.fixed = ""
        self.moment: SceneMoment | None = None
        self._picked = False
        self._first_link_at: Duration | None = None

    def ask(self) -> SceneMoment:
        """Look up, store and return the state of the scene at the selected time."""
        self.moment = self._answer()
        return self.moment

    def wait(self, moment: SceneMoment) -> SceneMoment:
        """Store and return the past state `moment`, with `behind` (the time since then) updated."""
        now = self.scene.world.clock.now()
        self.moment = replace(moment, behind=now - moment.stamp)
        return self.moment

    def pick(self, step: int) -> bool:
        """Move the cursor through the tree by `step` rows; return False if the tree is empty."""
        if self.moment is None:
            return False
        names = [row.info.frame for row in panels.rows(self.moment.snapshot)]
        if not names:
            return False
        at = names.index(self.source) if self.source in names else -1
        self.source = names[max(0, min(len(names) - 1, at + step))]
        self._picked = True
        return True

    def measure(self) -> None:
        """Make the frame under the cursor the pair's target."""
        self.target, self._picked = self.source, True

    def choose(self, frame: str) -> bool:
        """Move the cursor to a frame; return False if the cursor is already at the frame."""
        changed = frame != self.source
        self.source, self._picked = frame, True
        return changed

    def fix(self) -> None:
        """Make the frame under the cursor the fixed frame of the picture.

        If that frame is the fixed frame already, the root of the tree becomes the fixed frame.
        """
        self.fixed = "" if self.fixed == self.source else self.source

    def swap(self) -> None:
        """Exchange the target and the source of the pair."""
        self.target, self.source, self._picked = self.source, self.target, True

    def travel(self, step: Duration) -> None:
        """Move the selected time by `step` nanoseconds; at the present, show live frames."""
        now = self.scene.world.clock.now()
        there = (now if self.at is None else self.at) + step
        self.at = None if there >= now else max(there, self.scene.oldest())

    def _answer(self) -> SceneMoment:
        kept = self.moment
        if self.at is not None and kept is not None and kept.stamp == self.at:
            return self.scene.again(kept, self.target, self.source, self.fixed)
        found = self.scene.moment(self.at, self.target, self.source, self.fixed)
        pair = self._other_pair(found)
        if pair != (self.target, self.source):
            self.target, self.source = pair
            return self.scene.moment(self.at, *pair, self.fixed)
        return found

    def _other_pair(self, moment: SceneMoment) -> tuple[str, str]:
        """Return the pair to show: the selected pair, or a pair of existing frames.

        Only a pair that the user has not selected is replaced, and only if its frames do not exist.
        """
        asked, snapshot = (self.target, self.source), moment.snapshot
        if not self._picked and all(name in snapshot for name in self._wished):
            # The chosen frames exist now.
            return self._wished
        names = [info.frame for info in snapshot.frames if info.parent is not None]
        if self._picked or not names:
            return asked
        if self._first_link_at is None:
            self._first_link_at = moment.elapsed
        simulator = self.scene.simulator
        turtles = simulator is not None and bool(simulator.turtles)
        soon = turtles and moment.elapsed < PATIENCE
        # The pair shown in place of the chosen one may change its root while frames appear.
        settled = asked == self._wished or moment.elapsed >= self._first_link_at + PATIENCE
        if soon or (settled and all(name in snapshot for name in asked)):
            return asked
        last = "base_link" if "base_link" in names else names[-1]
        wished = self._wished[1]
        source = wished if wished in snapshot else last
        return snapshot.frame(source).root or names[0], source
