"""Tests that every exception of tftool survives pickle and copy, and never changes."""

import copy
import inspect
import pickle

import pytest

import tftool
from tftool import Buffer, Transform, TransformStamped, seconds
from tftool.base import errors
from tftool.base.errors import (
    BackwardExtrapolationException,
    ConnectivityException,
    DescriptionError,
    ForwardExtrapolationException,
    InvalidArgumentException,
    LookupException,
    MalformedMessage,
    Mistake,
    NodeArgumentsError,
    NodeFailed,
    ScenarioError,
    TftoolError,
    TimeoutException,
    TransformException,
)

LOOKUP = LookupException(
    '"turtel1" passed to lookupTransform argument source_frame does not exist. ',
    frame="turtel1",
    target="world",
    source="turtel1",
    known=("world", "turtle1"),
)
MADE = [
    TftoolError("something else."),
    NodeArgumentsError("too few words", status=1),
    ScenarioError("a.yaml", [Mistake("a.yaml", 1, 2, "no such node")]),
    DescriptionError("a.urdf", [Mistake("a.urdf", 1, 2, "no such joint")]),
    NodeFailed("arm", ValueError("no")),
    TransformException("x", target="a", source="b"),
    LOOKUP,
    ConnectivityException("x", target="a", source="b"),
    InvalidArgumentException("x", frame="/a"),
    TimeoutException("late", target="a", source="b", refusal=LOOKUP),
    BackwardExtrapolationException("x", requested=1, available=seconds(3), frame="a"),
    ForwardExtrapolationException("x", requested=seconds(3), available=1, frame="a"),
    MalformedMessage("std_msgs/msg/String", "too short"),
]


def facts(error):
    public = {name: value for name, value in vars(error).items() if name[0] != "_"}
    if "refusal" in public:
        public["refusal"] = facts(public["refusal"])
    return type(error), str(error), getattr(error, "remedy", ""), public


@pytest.mark.parametrize("error", MADE, ids=lambda error: type(error).__name__)
@pytest.mark.parametrize(
    "again", [lambda one: pickle.loads(pickle.dumps(one)), copy.copy, copy.deepcopy]
)
def test_an_exception_survives_pickle_and_copy_with_its_text_remedy_and_facts(error, again):
    assert facts(again(error)) == facts(error)


def test_every_exception_with_arguments_of_its_own_is_among_those_tried():
    own = {
        kind
        for _, kind in inspect.getmembers(errors, inspect.isclass)
        if issubclass(kind, TftoolError) and "__init__" in vars(kind)
    }
    tried = {base for error in MADE for base in type(error).__mro__}

    assert own <= tried


def test_a_remedy_does_not_change_with_the_buffer_that_refused():
    buffer = Buffer()
    with pytest.raises(LookupException) as refused:
        buffer.lookup_transform("world", "turtle1")
    before = refused.value.remedy

    buffer.set_transform(TransformStamped(1, "turtle1x", "turtle1y", Transform()))

    assert refused.value.remedy == before
    assert pickle.loads(pickle.dumps(refused.value)).remedy == before


def test_the_remedy_of_a_timeout_is_that_of_its_refusal_from_the_beginning():
    late = TimeoutException("late", refusal=LOOKUP)

    assert late.remedy == LOOKUP.remedy
    assert late.__cause__ is LOOKUP


@pytest.mark.parametrize(
    "ask",
    [
        tftool.diagnose,
        tftool.view,
        lambda given: tftool.explain(given, "map", "base"),
        lambda given: tftool.export(given, "map", "base", path="run.csv"),
    ],
)
def test_a_path_where_a_recording_is_wanted_is_told_how_to_open_it(ask):
    with pytest.raises(TypeError, match=r"not 'run.mcap': tftool.open_recording\('run.mcap'\)"):
        ask("run.mcap")
    with pytest.raises(TypeError, match="expected a Recording or a Buffer, not 42"):
        ask(42)


def test_a_moment_of_a_few_nanoseconds_is_explained():
    buffer = tftool.Buffer()
    for second in (1000, 1001):
        sample = tftool.TransformStamped(tftool.seconds(second), "a", "b", tftool.Transform())
        buffer.set_transform(sample)

    with pytest.raises(tftool.ExtrapolationException) as caught:
        buffer.lookup_transform("a", "b", time=1)

    assert caught.value.__notes__ == ["Times are whole nanoseconds: 1 is 1 ns, seconds(1) is 1 s."]
    assert caught.value.remedy == caught.value.__notes__[0]
    with pytest.raises(tftool.ExtrapolationException) as caught:
        buffer.lookup_transform("a", "b", time=tftool.seconds(5))
    assert not hasattr(caught.value, "__notes__")
