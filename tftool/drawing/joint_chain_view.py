"""Explanation of the joints between two links of a robot description, as text and JSON."""

from typing import Any

from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from tftool.base.plain_text import visible
from tftool.doctor.joint_chain import ChainExplanation, ChainLink
from tftool.drawing.explanation_view import SCHEMA, reasons


def render(explanation: ChainExplanation) -> RenderableType:
    """Return an explanation for a terminal: lookup, tf2's error, joints, cause, remedy."""
    headline = Text(visible(f"{explanation.source} in {explanation.target}: "))
    if explanation.available:
        headline.append("answers", "green")
    else:
        headline.append("refused", "bold red")
    parts: list[RenderableType] = [headline]
    if explanation.links:
        links = Table.grid(padding=(0, 2), pad_edge=False)
        for _ in range(3):
            links.add_column(no_wrap=True)
        links.add_column(overflow="fold")
        links.add_row("link", "joint", "type", "position", style="dim")
        for link in explanation.links:
            joint = link.joint
            links.add_row(
                Text(visible(f"{joint.child} in {joint.parent}")),
                Text(visible(joint.name)),
                joint.type,
                Text(visible(_position(link)), "" if link.is_known else "bold red"),
            )
        parts += [Text(""), Padding(links, (0, 0, 0, 2))]
    parts += [Text(""), reasons(explanation.text, explanation.why, explanation.remedies)]
    return Group(*parts)


def _position(link: ChainLink) -> str:
    if not link.is_known:
        return "REFUSES: the pose is unknown"
    if link.position is None:
        return "valid at all times" if link.joint.type == "fixed" else "at its origin"
    shown = f"{link.position:.4g} {link.joint.unit}"
    follows = f", follows {link.leader}" if link.leader != link.joint.name else ""
    return f"{shown}{follows}{'' if link.is_given else ', at rest'}"


def as_object(explanation: ChainExplanation) -> dict[str, Any]:
    """Return an explanation as a mapping in the schema of `tftool explain`; radians and metres."""
    return {
        "schema": SCHEMA,
        "target": explanation.target,
        "source": explanation.source,
        "stamp": 0,
        "available": explanation.available,
        "exception": explanation.exception or None,
        "text": explanation.text or None,
        "links": [
            {
                "parent": link.joint.parent,
                "child": link.joint.child,
                "kind": "static",
                "joint": link.joint.name,
                "type": link.joint.type,
                "position": link.position,
                "given": link.is_given,
                "leader": link.leader,
                "verdict": "answers" if link.is_known else "no-data",
            }
            for link in explanation.links
        ],
        "refusing": next(
            ([one.joint.parent, one.joint.child] for one in explanation.links if not one.is_known),
            None,
        ),
        "cause": explanation.cause,
        "why": list(explanation.why),
        "remedies": [
            {"text": text, "command": command or None} for text, command in explanation.remedies
        ],
    }
