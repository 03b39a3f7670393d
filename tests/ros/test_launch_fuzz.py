"""Tests that any launch file in XML or YAML is launched, or refused with a sentence."""

import tempfile
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.ros.tutorial import TUTORIAL, launch
from tftool.base.errors import TftoolError
from tftool.ros.host.importing import ros_free
from tftool.ros.host.workspace import Workspace
from tftool.ros.launch.arguments import show_arguments

FILES = Path(__file__).parent / "launch_files"
# The texts contain no system command, because a part of its name could be another command.
TEXTS = {
    ending: "\n".join(
        line
        for line in (FILES / f"whole.launch.{ending}").read_text().splitlines()
        if "executable: {" not in line and "<executable" not in line
    )
    for ending in ("xml", "yaml")
}
PIECES = [
    *["'", '"', "<", ">", "/>", "<group>", "</group>", "{", "}", "[", "]", ":", "- ", "\n", "  "],
    *["$(", ")", "$(var ", "$(dirname)", "$(not maybe)", "$(eval '", "~", "null", "1e999", "-1"],
    *["&a ", "*a", "!!python/name:os.system ", "? ", "<<: ", "\x00", "\x1b[31m", "\u202e", "&lt;"],
]


@st.composite
def changed(draw):
    """Return the text of a launch file with parts removed, repeated or inserted."""
    ending = draw(st.sampled_from(sorted(TEXTS)))
    text = TEXTS[ending]
    for _ in range(draw(st.integers(1, 4))):
        start = draw(st.integers(0, len(text)))
        end = min(len(text), start + draw(st.integers(0, 12)))
        text = text[:start] + draw(st.sampled_from([*PIECES, "", text[start:end] * 2])) + text[end:]
    return ending, text


@given(changed())
@example(("yaml", "launch:\n- ? [a]\n  : {b: c}\n"))
@example(("yaml", "launch: &a\n- group: *a\n"))
@example(("yaml", "launch:\n- log: {message: 2020-13-45}\n"))
@example(("yaml", "launch:\n- log: {message: !!python/object/apply:os.system [ls]}\n"))
@example(("yaml", "launch: " + "[" * 2000))
@example(("xml", "<launch>" + "<group>" * 500 + "</group>" * 500 + "</launch>"))
@example(("xml", "<launch><log message='" + "$(not " * 500 + ")" * 500 + "'/></launch>"))
@example(("xml", "<launch><log message=\"$('' x)\"/></launch>"))
def test_a_file_is_read_or_refused(case):
    ending, text = case
    with tempfile.TemporaryDirectory() as folder, ros_free():
        file = Path(folder) / f"a.launch.{ending}"
        file.write_text(text, encoding="utf-8")
        try:
            shown = show_arguments(file, Workspace(TUTORIAL))
        except TftoolError as error:
            shown = str(error)

    assert shown
    assert "Traceback" not in shown


@given(changed())
@settings(max_examples=25)
def test_a_file_is_launched_or_refused(case):
    ending, text = case
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"a.launch.{ending}"
        file.write_text(text, encoding="utf-8")
        (Path(folder) / "background.yaml").write_text((FILES / "background.yaml").read_text())
        (Path(folder) / "part.launch.xml").write_text((FILES / "part.launch.xml").read_text())
        try:
            done = launch(file, seconds=0.2)
        except TftoolError as error:
            cause = error.__cause__
            assert cause is None or isinstance(cause, TftoolError), repr(cause)
        else:
            assert all("Error:" not in line for line in done.said("launch"))


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("<timer period='nan'><log message='y'/></timer>", "seconds from 0 to 1e+09, not 'nan'"),
        ("<executable cmd=''/>", "ExecuteProcess needs a command"),
        ("<executable cmd='a' respawn='true' respawn_delay='soon'/>",
         "a respawn_delay must be seconds"),
        ("<node pkg='turtlesim' exec='turtlesim_node' namespace='a b'/>", "cannot be a namespace"),
        ("<push_ros_namespace namespace='1a'/>", "a part must not start with a number"),
        ("<include file='nothing.xml'/>", ":2: cannot read 'nothing.xml'"),
        ("<set_remap from='a b' to='c'/><node pkg='turtlesim' exec='turtlesim_node'/>",
         "'a b:=c' is not a valid remapping, because of the name 'a b': it must not contain"),
        ("<node pkg='turtlesim' exec='turtlesim_node'><param name='background_r' value='red'/>"
         "</node>", "'background_r' must be a whole number from 0 to 255, not 'red'"),
        ("<node pkg='turtlesim' exec='turtlesim_node'><param name='holonomic' value='2'/></node>",
         "parameter 'holonomic' must be true or false, not 2"),
    ],
)  # fmt: skip
def test_values_that_make_no_sense_are_told_with_their_line(tmp_path, text, told):
    file = tmp_path / "a.launch.xml"
    file.write_text(f"<launch>\n{text}\n</launch>")

    with pytest.raises(TftoolError) as refused:
        launch(file, seconds=1)

    assert f"{file}:2: " in str(refused.value.__cause__)
    assert told in str(refused.value.__cause__)
