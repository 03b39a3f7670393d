"""Leader and follower in a closed loop, compared with rows of the reference."""

import math

from tests.world.nodes.harness import After
from tests.world.nodes.vectors import close
from tftool.base.stamps import seconds
from tftool.messages.turtle_messages import Twist

HEAD_START = 2.0
"""Seconds before t = 0 in which the simulator does nothing: 125 ticks."""

BEARING_COUNTS_ABOVE = 0.01


class Loop:
    """Closed loop whose t = 0 is some time after the epoch; it records a row per tick."""

    def __init__(self, world, head_start=HEAD_START):
        self.world = world
        self.head_start = head_start
        self.sim = None
        self.commands = {}
        self.found = {}
        world.topic("turtle2/cmd_vel", Twist).subscribe(self._command)

    def now(self):
        return round(self.world.clock.elapsed() / 1e9 - self.head_start, 6)

    def _command(self, twist):
        self.commands[self.now()] = twist

    def sample(self):
        turtles = {name: turtle.place for name, turtle in self.sim.turtles.items()}
        # The past pose of turtle1 is interpolated between two ticks, as in the buffer.
        then = self.world.clock.now() - seconds(5)
        if self.world.buffer.can_transform("world", "turtle1", then):
            past = self.world.buffer.lookup_transform("world", "turtle1", then)
            turtles["past"] = past.transform.translation
        self.found[self.now()] = turtles

    def sample_at(self, times):
        After(self.world, *((self.head_start + t, self.sample) for t in times), name="sampler")

    def errors(self, expected):
        """Return the differences from the expected rows, by time."""
        missed = {}
        for row in expected:
            t = row["t"]
            wrong = list(self._errors(row, self.found[t], self.commands.get(t)))
            if wrong:
                missed[t] = wrong
        return missed

    def _errors(self, row, places, command):
        goal = self._goal(row, places)
        distance = row.get("distance_to_carrot", row.get("distance_to_where_turtle1_was"))
        if distance is None:
            distance = row.get("distance", math.inf)
        bearing_counts = distance > BEARING_COUNTS_ABOVE
        for short, name in (("t1", "turtle1"), ("t2", "turtle2")):
            if f"{short}_x" not in row:
                continue
            place = places[name]
            for what, kind in (("x", "xy"), ("y", "xy"), ("theta", "theta")):
                if what == "theta" and name == "turtle2" and not bearing_counts:
                    continue
                if not close(getattr(place, what), row[f"{short}_{what}"], kind):
                    yield f"{name}.{what}", getattr(place, what), row[f"{short}_{what}"]
        for column, found in goal.items():
            if not close(found, row[column], "distance"):
                yield column, found, row[column]
        if row["cmd_linear"] is None:
            if command is not None:
                yield "command", command, None
            return
        if not close(command.linear.x, row["cmd_linear"], "linear"):
            yield "linear", command.linear.x, row["cmd_linear"]
        if bearing_counts and not close(command.angular.z, row["cmd_angular"], "angular"):
            yield "angular", command.angular.z, row["cmd_angular"]

    def _goal(self, row, places):
        two = places["turtle2"]
        found = {}
        for column in ("distance", "distance_to_turtle1"):
            if column in row:
                one = places["turtle1"]
                found[column] = math.dist(one[:2], two[:2])
        if "distance_to_carrot" in row:
            one = places["turtle1"]
            found["distance_to_carrot"] = math.dist((one.x, one.y + 2.0), two[:2])
        if row.get("distance_to_where_turtle1_was") is not None:
            past = places["past"]
            found["distance_to_where_turtle1_was"] = math.dist(past[:2], two[:2])
        return found
