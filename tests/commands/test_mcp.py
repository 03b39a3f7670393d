"""Tests of the server for agents, with the client of the package `mcp`, over stdio."""

import asyncio
import json
import re
import sys
from collections import Counter

import pytest

pytest.importorskip("mcp", reason="mcp, of the extra 'test', is missing")

from mcp import Client, StdioServerParameters, stdio_client

import tftool as library
from tftool.commands.mcp import MOST_CHARACTERS, fitted

START, LENGTH = 1_700_000_000.0, 12.0
FAULTS = (
    "healthy",
    "split-tree",
    "edge-stopped",
    "gap",
    "teleport",
    "two-parents",
    "truncated-recording",
    "single-sample",
    "future-stamp",
    "static-and-dynamic",
)


class Drive:
    """Recording of a robot that drives along x, with known answers to all questions."""

    def __init__(self, number, fault):
        self.name, self.fault = f"runs/{number}-{fault}.mcap", fault
        self.speed, self.height = 0.2 + 0.1 * number, 0.1 + 0.05 * number
        self.ends = 4.0 if fault == "edge-stopped" else LENGTH
        self.base, self.greatest = [], 0.0

    def write(self, root):
        """Write the recording, with its fault."""
        rows = list(self._rows())
        with library.write_recording(root / self.name) as recording:
            for at, parent, child, place, static in sorted(rows, key=lambda row: row[0]):
                ahead = 0.4 if self.fault == "future-stamp" and child == "base_link" else 0.0
                stamp = library.seconds(START + at)
                sample = library.TransformStamped(stamp, parent, child, library.Transform(place))
                log = library.seconds(START + at - ahead + 0.005)
                (recording.static_transforms if static else recording.transforms)([sample], log)
        if self.fault == "truncated-recording":
            whole = (root / self.name).read_bytes()
            (root / self.name).write_bytes(whole[: len(whole) * 3 // 4])

    def _rows(self):
        """Yield second, parent, child, position and whether the transform is static."""
        mount = "chassis" if self.fault == "split-tree" else "base_link"
        yield 0.0, "base_link", "laser_link", (0.3, 0.0, self.height), True
        yield 0.001, mount, "camera_link", (0.1, 0.0, 0.5), True
        for step in range(int(LENGTH * 10) + 1):
            yield step / 10, "map", "odom", (1.0, 0.01 * step, 0.0), False
        for step in range(int(self.ends * 50) + 1):
            at = step / 50
            if self.fault == "gap" and 6.0 < at < 9.0:
                continue
            x = self.speed * at + (8.0 if self.fault == "teleport" and at > 5 else 0.0)
            self.base.append(at)
            self.greatest = max(self.greatest, x)
            yield at, "odom", "base_link", (x, 0.0, 0.0), False
            if self.fault == "two-parents" and 6.0 <= at <= 8.0:
                yield at + 0.003, "visual_odom", "base_link", (x, 0.1, 0.0), False
            if self.fault == "static-and-dynamic":
                yield at, "base_link", "laser_link", (0.3, 0.0, self.height), False
        if self.fault == "single-sample":
            yield 3.0, "base_link", "gps_link", (0.0, 0.2, 0.0), False

    @property
    def roots(self):
        return {
            "split-tree": {"map", "chassis"},
            "two-parents": {"map", "visual_odom"},
        }.get(self.fault, {"map"})


# Each function below is the plan of an agent for one kind of question, with at most three calls.


async def trees(ask, drive):
    assert set(await ask("tree", source=drive.name, part="roots")) == drive.roots


async def place(ask, drive):
    pair = {"target_frame": "odom", "source_frame": "laser_link"}
    found = await ask("echo", **pair, source=drive.name, at="2")
    assert found["translation"]["x"] == pytest.approx(2 * drive.speed + 0.3)
    assert found["translation"]["z"] == pytest.approx(drive.height)


async def refusal(ask, drive):
    pair = {"target_frame": "odom", "source_frame": "base_link"}
    found = await ask("explain", **pair, source=drive.name, at="1000")
    assert (found["available"], found["exception"]) == (False, "ForwardExtrapolationException")
    (link,) = found["links"]
    if drive.fault != "truncated-recording":
        assert link["held"]["newest"] == library.seconds(START + drive.base[-1])


async def fault(ask, drive):
    found = await ask("doctor", source=drive.name, part="summary")
    if drive.fault == "healthy":
        assert (found["error"], found["warning"]) == (0, 0)
        return
    found = await ask("doctor", source=drive.name, part="findings")
    ids = [one["id"] for one in found if isinstance(one, dict)]
    if drive.fault not in ids:
        # The list was shortened, so request this check alone.
        ids = [
            one["id"]
            for one in await ask("doctor", source=drive.name, check=drive.fault, part="findings")
        ]
    assert drive.fault in ids


async def counts(ask, drive):
    if drive.fault == "truncated-recording":
        assert await ask("info", source=drive.name, part="damage")
        return
    edges = await ask("info", source=drive.name, part="edges")
    (edge,) = (one for one in edges if (one["parent"], one["child"]) == ("odom", "base_link"))
    assert edge["count"] == len(drive.base)


async def reach(ask, drive):
    pair = {"target_frame": "odom", "source_frame": "base_link"}
    drawn = await ask("plot", **pair, source=drive.name, only="x")
    greatest = drawn["panels"][0]["curves"][0]["greatest"]
    if drive.fault == "truncated-recording":
        assert 0.5 * drive.greatest < greatest <= drive.greatest
    else:
        assert greatest == pytest.approx(drive.greatest, rel=1e-3)


PLAN = (trees, place, refusal, fault, counts, reach)


@pytest.fixture(scope="module")
def root(tmp_path_factory):
    root = tmp_path_factory.mktemp("root")
    (root / "runs").mkdir()
    return root


def served(root, work):
    """Serve the folder `root` to a client, and return the result of `work(client)`."""

    async def run():
        words = ["-m", "tftool", "mcp", str(root)]
        parameters = StdioServerParameters(command=sys.executable, args=words)
        async with Client(stdio_client(parameters)) as client:
            return await work(client)

    return asyncio.run(run())


def test_twenty_questions_about_broken_recordings_are_answered_by_the_plan(root):
    drives = [Drive(number, name) for number, name in enumerate(FAULTS)]
    for drive in drives:
        drive.write(root)
    right, wrong = Counter(), []

    async def work(client):
        atonce = asyncio.Semaphore(3)

        async def answer(question, drive):
            calls = 0

            async def ask(tool, **words):
                nonlocal calls
                calls += 1
                result = await client.call_tool(tool, words)
                (content,) = result.content
                assert not result.is_error, content.text
                assert len(content.text) <= MOST_CHARACTERS
                return json.loads(content.text)

            async with atonce:
                try:
                    await question(ask, drive)
                    assert calls <= 3
                    right[question.__name__] += 1
                except Exception as error:
                    wrong.append((question.__name__, drive.name, repr(error)))

        # Each answer needs a process. So every fault is used for two questions, and every question
        # for three faults.
        asked = [
            (question, drive)
            for number, question in enumerate(PLAN)
            for other, drive in enumerate(drives)
            if (number + other) % 3 == 0
        ]
        await asyncio.gather(*(answer(question, drive) for question, drive in asked))

    served(root, work)

    assert wrong == []
    assert right.total() == 20


def test_only_what_is_below_the_root_is_read_and_only_what_runs_no_code(tmp_path):
    root, outside = tmp_path / "root", tmp_path / "outside"
    root.mkdir()
    outside.mkdir()
    urdf = (
        '<robot name="r"><link name="secret"/><link name="b"/><joint name="j" type="fixed">'
        '<parent link="secret"/><child link="b"/></joint></robot>'
    )
    (outside / "r.urdf").write_text(urdf)
    (root / "r.urdf").write_text(urdf.replace("secret", "base"))
    (root / "link.urdf").symlink_to(outside / "r.urdf")
    (root / "folder").symlink_to(outside)
    bag = root / "bag"
    bag.mkdir()
    (bag / "metadata.yaml").symlink_to(outside / "r.urdf")
    (root / "r.xacro").write_text(urdf)
    (root / "s.yaml").write_text("duration: 1 s\nnodes: [static: {parent: a, child: b}]\n")
    (root / "tftool.py").write_text("raise SystemExit('code of the folder ran')")
    (root / "--help").write_text(urdf.replace("secret", "option"))

    async def work(client):
        refused = {}
        for source in (
            "../outside/r.urdf", str(outside / "r.urdf"), "link.urdf", "folder/r.urdf", "bag",
            "r.xacro", "s.yaml", "turtles", "nothing.mcap", "a\0b",
        ):  # fmt: skip
            result = await client.call_tool("tree", {"source": source})
            assert result.is_error, source
            refused[source] = result.content[0].text
        fine = await client.call_tool("tree", {"source": "r.urdf"})
        option = await client.call_tool("tree", {"source": "--help"})
        listed = await client.call_tool("info", {})
        part = await client.call_tool("info", {"source": "r.urdf", "part": "nothing"})
        return refused, fine, option, listed, part

    refused, fine, option, listed, part = served(root, work)

    assert not any("secret" in text for text in refused.values())
    assert "is outside of the folder" in refused["link.urdf"]
    assert "is outside of the folder" in refused["bag"]
    assert "may run code" in refused["r.xacro"]
    assert "is a scenario" in refused["s.yaml"]
    assert json.loads(fine.content[0].text)["roots"] == ["base"]
    assert json.loads(option.content[0].text)["roots"] == ["option"]
    assert json.loads(listed.content[0].text) == ["r.urdf"]
    assert "The answer has no part 'nothing'; its parts are:" in part.content[0].text


def test_its_tools_say_that_they_only_read(root):
    async def work(client):
        return (await client.list_tools()).tools

    tools = served(root, work)

    names = ["info", "tree", "echo", "explain", "doctor", "plot"]
    assert [tool.name for tool in tools] == names
    assert all(tool.annotations.read_only_hint for tool in tools)


def test_a_root_that_is_no_folder_is_refused(tftool, tmp_path):
    result = tftool("mcp", tmp_path / "nowhere")

    assert result.status == 3
    assert "is not a folder" in result.err


def test_without_the_package_the_extra_is_named(tftool, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "mcp.server", None)

    result = tftool("mcp", tmp_path)

    assert result.status == 2
    assert "pip install 'tftool-tf2[mcp]'" in result.err


@pytest.mark.parametrize(
    "answer",
    [
        list(range(5000)),
        {"findings": [{"id": str(n), "evidence": ["x" * 300] * 50} for n in range(40)]},
        {"text": '"' * 9000},
        [["é" * 100] * 100] * 100,
    ],
)
def test_a_long_answer_is_cut_and_says_how_much_is_missing(answer):
    text = fitted(answer)

    assert len(text) <= MOST_CHARACTERS
    assert re.search(r"\d+ (characters )?more", text) or "missing_characters" in json.loads(text)
    assert fitted([1, 2]) == "[1, 2]"
