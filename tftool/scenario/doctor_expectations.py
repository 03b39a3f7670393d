"""Rules for the doctor (the checks of transforms), in a scenario or in a file beside a recording.

The doctor and numpy are imported only if an expectation needs the doctor.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from tftool.base.errors import ScenarioError
from tftool.scenario import units as values
from tftool.scenario.document import Document, Node, text_of
from tftool.scenario.fields import Key, Reading, Unreadable, quoted, suggest

if TYPE_CHECKING:
    from tftool.doctor.model import Settings

ENDING = ".doctor.yaml"
"""Ending of the name of a file with rules beside a recording."""


@dataclass(frozen=True, slots=True)
class DoctorRules:
    """Rules for the doctor: checks not to run, and thresholds.

    Attributes:
        ignore: Ids of checks not to run, or areas (groups of checks).
        limits: Thresholds, by check and by name.
    """

    ignore: tuple[str, ...] = ()
    limits: Mapping[str, Mapping[str, float]] = field(default_factory=dict)

    def settings(self, settings: "Settings") -> "Settings":
        """Return a command's settings, with these rules' thresholds as defaults."""
        limits = {name: dict(of) for name, of in self.limits.items()}
        for name, of in settings.limits.items():
            limits.setdefault(name, {}).update(of)
        return replace(settings, limits=limits)


NO_RULES = DoctorRules()


def check_or_area(node: Node, reading: Reading) -> str:
    """Read the id of one of the doctor's checks, or the name of an area (group of checks)."""
    from tftool.doctor.judge import AREAS, CHECKS

    word = reading.text(node, "a check").replace(" ", "-")
    known = (*CHECKS, *AREAS)
    if word not in known:
        near = suggest(word, known) or "; 'tftool doctor --list' shows all"
        raise reading.refuse(node, f"there is no check or area {quoted(word)}{near}")
    return word


def limits(node: Node, reading: Reading) -> Mapping[str, Mapping[str, float]]:
    """Read thresholds of the doctor's checks from a mapping, such as `{gap.seconds: 2}`."""
    from tftool.doctor.judge import CHECKS

    found: dict[str, dict[str, float]] = {}
    number = values.quantity(values.NUMBER, least=0.0)
    whole = True
    for word, (key, value) in reading.entries(node, "gap.seconds: 2").items():
        check, _, name = word.partition(".")
        known = [f"{one}.{limit}" for one, what in CHECKS.items() for limit in what.limits]
        if word not in known:
            whole = False
            reading.note(key, f"there is no threshold {quoted(word)}{suggest(word, known)}")
            continue
        read = reading.try_read(number, value)
        if isinstance(read, float):
            found.setdefault(check, {})[name] = read
        else:
            whole = False
    if not whole:
        raise Unreadable
    return MappingProxyType(found)


def rules(node: Node, reading: Reading) -> DoctorRules:
    """Read rules for the doctor, such as `{ignore: [gap, names], limits: {gap.seconds: 2}}`."""
    known = {
        "ignore": Key(values.several(check_or_area, "checks"), ()),
        "limits": Key(limits, MappingProxyType({})),
    }
    return DoctorRules(**reading.record(node, known, "doctor"))


def rules_beside(path: str | Path) -> tuple[DoctorRules, Path | None]:
    """Return (rules, file) from `run.doctor.yaml` beside `run.mcap`, or (`NO_RULES`, None).

    Raises:
        InputError: If the file cannot be read; a `ScenarioError` lists every mistake in the file.
    """
    recording = Path(path)
    for name in (f"{recording.name}{ENDING}", f"{recording.stem}{ENDING}"):
        file = recording.with_name(name) if recording.name else recording / name
        if file.is_file():
            return _parsed(text_of(file), str(file)), file
    return NO_RULES, None


def _parsed(text: str, name: str) -> DoctorRules:
    source = Document(text, name)
    reading = Reading(source)
    try:
        root = source.read()
        reading.mistakes.extend(source.mistakes)
        found = rules(root, reading)
        if reading.mistakes:
            raise Unreadable
    except Unreadable as error:
        raise ScenarioError(name, reading.mistakes) from error
    return found
