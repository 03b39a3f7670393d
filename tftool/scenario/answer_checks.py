"""What an answer must be: a range, a pose, a refusal, names.

A `Form` reads the keys that stand beside a question and makes a check of them;
the check judges answers and says in words what it expects and what it found.
"""

from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from tftool.base.errors import LookupException, TransformException
from tftool.base.near_names import near_names
from tftool.geometry.planar import wrap
from tftool.scenario import units as values
from tftool.scenario.document import TextPlace
from tftool.scenario.fields import Key, Reading, listed
from tftool.scenario.units import ANGLE, Unit

NEAR = 1e-6
"""How far a value may be off where no tolerance is given: metres, radians, the rest."""


@dataclass(frozen=True, slots=True)
class Judged:
    """What became of one look: whether it holds, and what was found, in words."""

    ok: bool
    found: str


def _meant(error: TransformException) -> str:
    """Which frame's name is near the one that is unknown; empty without one."""
    remedy = error.remedy if isinstance(error, LookupException) else ""
    return remedy if "did you mean" in remedy else ""


class AnswerCheck(ABC):
    """What an answer must be; its text follows the question in a sentence."""

    @abstractmethod
    def judge(self, answer: Any) -> Judged:
        """Compare an answer."""

    def refused(self, error: TransformException) -> Judged:
        """Judge that there is no answer."""
        # Some of tf2's sentences end in a full stop and a blank, others in neither.
        hint = _meant(error)
        said = f"{str(error).rstrip(' .')}. {hint}" if hint else str(error)
        return Judged(False, f"{type(error).__name__}: {said}")

    @abstractmethod
    def __str__(self) -> str: ...


class Form(ABC):
    """The keys of one kind of check.

    Attributes:
        fields: What may stand beside the question.
    """

    fields: Mapping[str, Key]

    @abstractmethod
    def make(self, given: Mapping[str, Any], reading: Reading, place: TextPlace) -> AnswerCheck:
        """Make the check of what was given beside the question and in it."""


# Numbers.


@dataclass(frozen=True, slots=True)
class RangeCheck(AnswerCheck):
    """A number within bounds; bounds themselves are outside, except of `between`."""

    unit: Unit
    below: float | None = None
    above: float | None = None
    between: tuple[float, float] | None = None
    equal: float | None = None
    tolerance: float = NEAR

    def judge(self, answer: float) -> Judged:
        """Compare an answer."""
        ok = True
        if self.below is not None:
            ok = ok and answer < self.below
        if self.above is not None:
            ok = ok and answer > self.above
        if self.between is not None:
            ok = ok and self.between[0] <= answer <= self.between[1]
        if self.equal is not None:
            off = answer - self.equal
            ok = ok and abs(wrap(off) if self.unit is ANGLE else off) <= self.tolerance
        return Judged(ok, self._shown(answer))

    def __str__(self) -> str:
        parts = []
        if self.below is not None:
            parts.append(f"below {self._shown(self.below)}")
        if self.above is not None:
            parts.append(f"above {self._shown(self.above)}")
        if self.between is not None:
            low, high = self.between
            parts.append(f"between {low:g} and {self._shown(high)}")
        if self.equal is not None:
            off = "" if self.tolerance in (0.0, NEAR) else f" ± {self._shown(self.tolerance)}"
            parts.append(f"is {self._shown(self.equal)}{off}")
        return " and ".join(parts)

    def _shown(self, value: float) -> str:
        return f"{value:.6g} {self.unit.name}".rstrip()


class RangeForm(Form):
    """below, above, between, is with a tolerance: at least one of them."""

    def __init__(
        self, unit: Unit, default: RangeCheck | None = None, tolerance: float = NEAR
    ) -> None:
        """Numbers of one unit; `default` is what is meant when nothing is said."""
        self.unit = unit
        self.default = default
        self.tolerance = tolerance
        one = values.quantity(unit)
        self.fields = {
            "below": Key(one, None),
            "above": Key(one, None),
            "between": Key(values.several(one, "lower and upper bound", 2), None),
            "is": Key(one, None),
            "tolerance": Key(values.quantity(unit, least=0.0), None),
        }

    def make(self, given: Mapping[str, Any], reading: Reading, place: TextPlace) -> RangeCheck:
        """Make the check, or note what is wrong."""
        asked = [key for key in ("below", "above", "between", "is") if given[key] is not None]
        if not asked:
            if self.default is not None:
                return self.default
            raise reading.refuse(
                place, "what must it be? say below, above, between: [low, high], or is"
            )
        if given["tolerance"] is not None and given["is"] is None:
            raise reading.refuse(place, "a tolerance goes with 'is'")
        between = given["between"]
        if between is not None and between[0] > between[1]:
            raise reading.refuse(place, f"between {between[0]:g} and {between[1]:g} lies nothing")
        tolerance = self.tolerance if given["tolerance"] is None else given["tolerance"]
        return RangeCheck(
            self.unit, given["below"], given["above"], between, given["is"], tolerance
        )


# Frames and names.


def _nearest(wanted: Iterable[str], known: Collection[str]) -> str:
    """Which names that there are may be meant by those that there are not, one for each."""
    found = [near_names(name, known) for name in wanted if name not in known]
    near = [f"'{names[0]}'" for names in found if names]
    return f"; did you mean {', '.join(near)}?" if near else ""


@dataclass(frozen=True, slots=True)
class FrameFacts:
    """What is known of a frame; all None when it is not known at all.

    Attributes:
        exists: Whether it is known.
        parent: What it hangs from.
        static: Whether it holds at all times.
        broadcaster: Who sends it.
        known: The frames that there are.
    """

    exists: bool
    parent: str | None = None
    static: bool | None = None
    broadcaster: str | None = None
    known: Collection[str] = field(default=(), compare=False)


@dataclass(frozen=True, slots=True)
class FrameCheck(AnswerCheck):
    """A frame of which these facts hold; what is None is not looked at."""

    name: str
    wanted: FrameFacts

    def judge(self, answer: FrameFacts) -> Judged:
        """Compare an answer."""
        if not answer.exists:
            hint = _nearest([self.name], answer.known)
            return Judged(not self.wanted.exists, f"no such frame{hint}")
        ok = self.wanted.exists
        for key in ("parent", "static", "broadcaster"):
            want = getattr(self.wanted, key)
            ok = ok and (want is None or want == getattr(answer, key))
        if answer.parent is None:
            return Judged(ok, "a root")
        kind = "static" if answer.static else "dynamic"
        hint = "" if self.wanted.parent is None else _nearest([self.wanted.parent], answer.known)
        return Judged(ok, f"{kind}, under {answer.parent}, from {answer.broadcaster}{hint}")

    def __str__(self) -> str:
        if not self.wanted.exists:
            return "does not exist"
        parts = []
        if self.wanted.static is not None:
            parts.append("is static" if self.wanted.static else "is dynamic")
        if self.wanted.parent is not None:
            parts.append(f"hangs under {self.wanted.parent}")
        if self.wanted.broadcaster is not None:
            parts.append(f"comes from {self.wanted.broadcaster}")
        return ", ".join(parts) or "exists"


class FrameForm(Form):
    """exists, parent, static, broadcaster."""

    fields: Mapping[str, Key] = {
        "exists": Key(values.flag, True),
        "parent": Key(values.frame, None),
        "static": Key(values.flag, None),
        "broadcaster": Key(values.name("a node"), None),
    }

    def make(self, given: Mapping[str, Any], reading: Reading, place: TextPlace) -> AnswerCheck:
        """Make the check, or note what is wrong."""
        facts = FrameFacts(**{key: given[key] for key in self.fields})
        if not facts.exists and facts != FrameFacts(False):
            raise reading.refuse(place, "a frame that does not exist has nothing else to it")
        return FrameCheck(given["name"], facts)


@dataclass(frozen=True, slots=True)
class NamesCheck(AnswerCheck):
    """Exactly these names, in any order."""

    wanted: frozenset[str]

    def judge(self, answer: Iterable[str]) -> Judged:
        """Compare an answer."""
        found = frozenset(answer)
        # What was written rightly is not meant by what was not.
        hint = _nearest(sorted(self.wanted - found), found - self.wanted)
        return Judged(found == self.wanted, f"{listed(sorted(found)) or 'none'}{hint}")

    def __str__(self) -> str:
        return f"are {listed(sorted(self.wanted)) or 'none'}"


class NamesForm(Form):
    """Nothing beside: the question holds the names."""

    fields: Mapping[str, Key] = {}

    def make(self, given: Mapping[str, Any], reading: Reading, place: TextPlace) -> AnswerCheck:
        """Make the check, or note what is wrong."""
        return NamesCheck(frozenset(given["names"]))


class CountForm(Form):
    """Nothing beside: the question holds the count."""

    fields: Mapping[str, Key] = {}

    def make(self, given: Mapping[str, Any], reading: Reading, place: TextPlace) -> AnswerCheck:
        """Make the check, or note what is wrong."""
        return RangeCheck(values.NUMBER, equal=float(given["count"]), tolerance=0.0)


@dataclass(frozen=True, slots=True)
class CleanCheck(AnswerCheck):
    """No findings at all."""

    def judge(self, answer: Iterable[str]) -> Judged:
        """Compare an answer."""
        found = list(answer)
        return Judged(not found, "; ".join(found) or "none")

    def __str__(self) -> str:
        return "are none"


class CleanForm(Form):
    """Nothing beside: the question says what is left out."""

    fields: Mapping[str, Key] = {}

    def make(self, given: Mapping[str, Any], reading: Reading, place: TextPlace) -> CleanCheck:
        """Make the check."""
        return CleanCheck()
