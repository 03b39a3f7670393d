"""Checks of a recording as a whole: whether it has transforms, and whether its files are whole."""

from collections.abc import Iterator

from tftool.base.plain_text import count
from tftool.doctor.check import checks_of
from tftool.doctor.findings import Area, Fix, Hit, Severity
from tftool.doctor.model import Limits, Model
from tftool.doctor.wording import is_ros, several
from tftool.recordings.container_reader import TRANSFORM_TYPES

check = checks_of(Area.COVERAGE)


@check(
    "no-transforms",
    Severity.ERROR,
    rule="no topic carries a transform. A warning if no message has a position either. A note for "
    "a recording without a topic for transforms, if no message header names a frame",
    headline="there are no transforms{unread}",
    consequence="{so}",
    causes=("/tf and /tf_static were not in the recorder's list",),
    because_of=(("anything", "namespaced-topic"),),
)
def no_transforms(model: Model, limits: Limits) -> Iterator[Hit]:
    """The recording has no transforms."""
    if not model.tracks and not model.nameless:
        is_needed = any(heard.is_spatial for heard in model.heard)
        lists = [
            one for one in model.evidence.topics if one.transforms or one.type in TRANSFORM_TYPES
        ]
        unread = [
            f"{count(one.count, 'message')} on {one.name} in the encoding {one.encoding}"
            for one in lists
            if one.count and not one.transforms
        ]
        told, so, severity = "", "nothing can be placed in another frame", None
        command = ": `{publishers} /tf`" if is_ros(model.evidence) else ""
        fix = Fix(f"check whether the robot sends transforms{command}; if so, record /tf")
        if unread:
            told = f" that tftool can read: {several(unread)}"
            fix = Fix("tftool reads tf2_msgs/TFMessage in the encodings cdr, ros1 and json")
        if not is_needed:
            severity = Severity.WARNING
        if model.evidence.recorded and not lists and not _names_frame(model):
            severity, told = Severity.NOTE, ", and no message header names a frame"
            so = "none: no message that tftool can read has a place in a frame"
        yield Hit(
            topics=tuple(one.name for one in lists if one.transforms),
            severity=severity,
            facts={"unread": told, "so": so},
            fixes=(fix,),
        )


def _names_frame(model: Model) -> bool:
    """Whether a header names a frame, or messages that do not begin with a header may name one."""
    others = (one for one in model.evidence.topics if one.name not in model.evidence.headers)
    return any(one.frame for one in model.heard) or any(
        one.count and ("frame_id" in one.definition or one.type.startswith("visualization_msgs/"))
        for one in others
    )


@check(
    "truncated-recording",
    Severity.WARNING,
    rule="the recording is damaged or incomplete, or a file has another name than in the metadata",
    headline="files of the recording are damaged, missing or renamed",
    detail="{damage}",
    consequence="this report covers only the data that can be read",
    causes=(
        "the recorder was killed",
        "a full disk",
    ),
)
def truncated_recording(model: Model, limits: Limits) -> Iterator[Hit]:
    """The file is damaged, or parts of it are missing: the recorder was killed, for example."""
    if model.evidence.damage:
        yield Hit(facts={"damage": " ".join(model.evidence.damage)}, alone=True)
