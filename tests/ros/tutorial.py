"""The tutorial's package, and functions that run it on simulated time."""

from dataclasses import dataclass, field
from pathlib import Path

from tftool.base.stamps import seconds as stamp
from tftool.ros.host import executables, names
from tftool.ros.host.importing import ros_free
from tftool.ros.host.workspace import Workspace, use_workspace
from tftool.ros.launch.engine import Launch
from tftool.ros.running import until
from tftool.world.clock import SimClock, run
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.supervisor import live
from tftool.world.world import World

TUTORIAL = Path(__file__).parent.parent / "tutorial" / "pkg_tf"


@dataclass
class Launched:
    """Result of a launch."""

    lines: list = field(default_factory=list)
    records: list = field(default_factory=list)
    failed: list = field(default_factory=list)
    places: dict = field(default_factory=dict)
    nodes: dict = field(default_factory=dict)
    topics: dict = field(default_factory=dict)
    elapsed: float = 0.0

    def said(self, who):
        """Return what the launch logged about a process, or about itself."""
        return [text for _, one, text in self.lines if one == who]

    def texts(self, node):
        """Return the log of a node."""
        return [record.text for record in self.records if record.node == node]


def launch(file, *, seconds, arguments=None, start=TUTORIAL):
    """Launch a file on simulated time; return the result."""
    done = Launched()
    with ros_free():
        workspace = Workspace(start)
        use_workspace(workspace)
        clock = SimClock()
        world = World(clock)
        world.log.listen(done.records.append)
        started = Launch(
            world,
            file,
            workspace=workspace,
            arguments=arguments,
            say=lambda *line: done.lines.append(line),
        )

        async def main():
            import asyncio

            living = asyncio.ensure_future(live(world))
            waiting = asyncio.ensure_future(until(world, started.ended, stamp(seconds)))
            await asyncio.wait({living, waiting}, return_when=asyncio.FIRST_COMPLETED)
            done.elapsed = clock.elapsed() / 1e9
            if living.done():
                waiting.cancel()
                living.result()
            see(world, done)
            living.cancel()
            await asyncio.gather(living, waiting, return_exceptions=True)

        run(clock, main())
    done.failed = started.failed
    return done


def see(world, done):
    """Store the world's nodes and topics, and the turtles' poses, in the result."""
    done.nodes = {node.name: node for node in world.nodes}
    done.topics = dict(world.topics())
    for node in world.nodes:
        if isinstance(node, Turtlesim):
            for name, turtle in node.turtles.items():
                done.places[name] = tuple(turtle.place)


def start(world, executable, *words, package="pkg_tf", on_exit=None):
    """Start one of the tutorial's executables in a world."""
    options, arguments = names.parse(words)
    return executables.start(
        world,
        executables.find(Workspace(TUTORIAL), package, executable),
        label=f"{executable}-{len(world.nodes)}",
        argv=[executable, *words],
        arguments=arguments,
        options=options,
        on_exit=on_exit,
    )
