"""Tests of launches on the wall clock, where programs' threads run side by side."""

import asyncio
import gc
import itertools
import sys
from types import ModuleType

from tests.patience import PATIENCE
from tests.ros.tutorial import Launched
from tftool.ros.host.importing import ros_free
from tftool.ros.host.workspace import Workspace, use_workspace
from tftool.ros.launch.engine import Launch
from tftool.world.clock import WallClock, run
from tftool.world.supervisor import live
from tftool.world.world import World


def launch_live(file, start) -> Launched:
    """Launch a file whose programs end by themselves."""
    done = Launched()
    with ros_free():
        workspace = Workspace(start)
        use_workspace(workspace)
        world = World(WallClock())
        started = Launch(
            world, file, workspace=workspace, say=lambda *line: done.lines.append(line)
        )

        def keep(record):
            done.records.append(record)
            done.lines.append(("", started.label_of(record), record.text))

        world.log.listen(keep)

        async def main():
            living = asyncio.ensure_future(live(world))
            await started.ended.wait()
            living.cancel()
            await asyncio.gather(living, return_exceptions=True)

        run(world.clock, main())
    done.failed = started.failed
    return done


def package(folder, **scripts):
    """Create a package `pkg` with these scripts."""
    place = folder / "pkg" / "scripts"
    place.mkdir(parents=True)
    (folder / "pkg" / "package.xml").write_text("<package><name>pkg</name></package>")
    for name, code in scripts.items():
        (place / f"{name}.py").write_text(code)


def test_nodes_of_one_name_live_side_by_side(tmp_path):
    package(
        tmp_path,
        # Each program runs until all have seen the last one, because the name of an ended node is
        # free again. If one program fails, the others give up.
        same="import pathlib\nimport time\nimport uuid\n"
        "import rclpy\nfrom rclpy.lifecycle import LifecycleNode\nrclpy.init()\n"
        "node = LifecycleNode('same')\nnode.get_logger().info('here')\n"
        f"end = time.time() + {PATIENCE}\n"
        "while len(node.get_node_names()) < 4 and time.time() < end:\n    time.sleep(0.05)\n"
        f"seen = pathlib.Path({str(tmp_path)!r}, 'seen')\nseen.mkdir(exist_ok=True)\n"
        "(seen / uuid.uuid4().hex).touch()\n"
        "while len(list(seen.iterdir())) < 4 and time.time() < end:\n    time.sleep(0.05)\n",
    )
    file = tmp_path / "many.launch.yaml"
    file.write_text("launch:\n" + 4 * "- node: {pkg: pkg, exec: same.py}\n")
    done = launch_live(file, tmp_path)

    assert done.failed == [], "\n".join(map(str, done.lines))
    assert done.texts("same") == 4 * ["here"]
    # Each line is logged with the label of its process, whatever the node's name.
    assert all(done.said(f"same.py-{number}").count("here") == 1 for number in range(1, 5))
    named = [text for who in range(1, 5) for text in done.said(f"same.py-{who}") if "shown" in text]
    assert len(named) == 3


def test_a_program_starts_while_the_garbage_collector_lets_others_import(tmp_path):
    package(tmp_path, alone="import rclpy\nrclpy.init()\n")
    file = tmp_path / "one.launch.yaml"
    file.write_text("launch:\n- node: {pkg: pkg, exec: alone.py}\n")
    numbers = itertools.count()
    added: list[str] = []

    def import_another(phase, info):
        # As finalizers do, during which other programs run on.
        added.append(f"imported_meanwhile_{next(numbers)}")
        sys.modules[added[-1]] = ModuleType(added[-1])

    before = gc.get_threshold()
    gc.callbacks.append(import_another)
    gc.set_threshold(2, 1_000, 1_000)
    try:
        done = launch_live(file, tmp_path)
    finally:
        gc.set_threshold(*before)
        gc.callbacks.remove(import_another)
        for name in added:
            sys.modules.pop(name, None)

    assert added
    assert done.failed == [], "\n".join(map(str, done.lines))
