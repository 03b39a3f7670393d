"""Exercises: the tutorial's nodes with their key lines removed for the learner to write."""

import ast
from typing import Final

LINES: Final = {
    "static_frame": {
        "t.header.frame_id": "TODO: t.header.frame_id, the frame in which the shelf is measured",
        "t.child_frame_id": "TODO: t.child_frame_id, the frame that is new",
        "t.transform.translation.z": "TODO: how high the shelf is, in metres",
    },
    "turtle_broadcaster": {
        "t.header.frame_id": "TODO: t.header.frame_id, the frame in which the pose is given",
        "t.child_frame_id": "TODO: t.child_frame_id, the frame that moves",
        "t.transform.rotation.z": "TODO: t.transform.rotation.z, from pose.theta",
        "t.transform.rotation.w": "TODO: t.transform.rotation.w, from pose.theta",
    },
    "turtle_follower": {
        "found": 'raise TransformException("TODO: look the transform up, as `found`")',
        "command.linear.x": "TODO: command.linear.x, half of how far the goal is",
        "command.angular.z": "TODO: command.angular.z, the direction of the goal",
    },
    "fixed_carrot": {
        "t.header.frame_id": "TODO: t.header.frame_id, the frame that carries the carrot",
        "t.child_frame_id": "TODO: t.child_frame_id, the frame that is new",
        "t.transform.translation.y": "TODO: two metres to the left",
    },
    "moving_carrot": {
        "t.header.frame_id": "TODO: t.header.frame_id, the frame that carries the carrot",
        "t.transform.translation.x": "TODO: t.transform.translation.x, on a circle of two metres",
        "t.transform.translation.y": "TODO: t.transform.translation.y, likewise",
    },
    "time_traveller": {
        "found": 'raise TransformException("TODO: look up turtle1 as it was, as `found`")',
    },
}
"""Replacement of each assignment: a comment, or a line that runs where one must."""


def with_blanks(node: str, text: str) -> str:
    """Return a node's source with a TODO in place of each key line."""
    wanted = LINES[node]
    lines = text.splitlines(keepends=True)
    found = [one for one in ast.walk(ast.parse(text)) if isinstance(one, ast.Assign)]
    # From the end, so that the numbers of the lines before stay right.
    for one in sorted(found, key=lambda one: one.lineno, reverse=True):
        blank = wanted.get(ast.unparse(one.targets[0]))
        if blank is not None:
            mark = "# " if blank.startswith("TODO") else ""
            line = f"{' ' * one.col_offset}{mark}{blank}\n"
            lines[one.lineno - 1 : one.end_lineno] = [line]
    return "".join(lines)
