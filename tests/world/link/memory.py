"""Second middleware behind the interface of `seam.py`: a list in memory connects worlds."""

import itertools
from collections import deque

from tftool.base.errors import LinkError
from tftool.world.endpoints import CLIENT, PUBLISHER, SUBSCRIPTION, Quality
from tftool.world.link.graph import NODE, SERVER, Graph, GraphEntity
from tftool.world.link.reach import Reach
from tftool.world.link.seam import Arrived, Middleware


class MemoryMiddleware(Middleware):
    """One of several middlewares that exchange messages at once; see `seam.Middleware`."""

    members: "list[MemoryMiddleware]" = []  # noqa: RUF012
    numbers = itertools.count(1)

    def __init__(self, options):
        super().__init__(Graph(f"{next(self.numbers):x}", options.domain))
        self.options = options
        self.shown, self.heard, self.servers = {}, [], {}
        self.loop = None
        for other in self.members:
            for key, found in other.shown.items():
                self.graph.add(key, found)
        self.members.append(self)

    def start(self, loop, watcher=None):
        self.loop, self.watcher = loop, watcher

    def close(self):
        if self in self.members:
            self.members.remove(self)
            for key in tuple(self.shown):
                self._hide(key)

    def process(self, process):
        return self._show(process)

    def node(self, name):
        return self._show(GraphEntity(NODE, self.options.domain, self.session, name))

    def subscription(self, node, name, ros_type, quality):
        return self._show(self._entity(SUBSCRIPTION, node, name, ros_type, quality))

    def publisher(self, node, name, ros_type, quality):
        entity = self._entity(PUBLISHER, node, name, ros_type, quality)
        return Publisher(self, entity, self._show(entity))

    def listen(self, name, ros_type, on_message, *, is_latched=False):
        ear = (name, ros_type, on_message)
        self.heard.append(ear)
        for other in self.others() if is_latched else ():
            for key, kept in getattr(other, "kept", {}).items():
                if key[0] == name:
                    for arrived in kept:
                        self.call(on_message, arrived)
        return lambda: self.heard.remove(ear)

    def server(self, node, name, ros_type, on_request):
        self.servers[name] = on_request
        hide = self._show(self._entity(SERVER, node, name, ros_type, Quality()))

        def leave():
            del self.servers[name]
            hide()

        return leave

    def client(self, node, name, ros_type):
        return Client(self, self._entity(CLIENT, node, name, ros_type, Quality()))

    def call(self, callback, argument):
        if self.loop is not None:
            self.loop.call_soon(callback, argument)

    def report(self, found, there):
        if self.watcher is not None:
            self.call(lambda found: self.watcher.graph_changed(found, there), found)

    def others(self):
        return [one for one in self.members if one is not self]

    def _entity(self, kind, node, name, ros_type, quality):
        gid = next(self.numbers).to_bytes(16, "little")
        return GraphEntity(
            kind, self.options.domain, self.session, node, name, ros_type, quality, gid
        )

    def _show(self, found):
        key = f"{self.session}/{next(self.numbers)}"
        self.shown[key] = found
        for other in self.others():
            new = other.graph.add(key, found)
            if new is not None:
                other.report(new, True)
        return lambda: self._hide(key)

    def _hide(self, key):
        self.shown.pop(key, None)
        for other in self.others():
            gone = other.graph.remove(key)
            if gone is not None:
                other.report(gone, False)


class Publisher:
    def __init__(self, middleware, entity, hide):
        self.middleware, self.entity, self.hide = middleware, entity, hide
        self.kept = deque(maxlen=entity.quality.depth if entity.quality.is_latched else 0)
        middleware.kept = getattr(middleware, "kept", {})
        middleware.kept[entity.name, entity.gid] = self.kept

    @property
    def is_wanted(self):
        ears = [ear for other in self.middleware.others() for ear in other.heard]
        return self.entity.quality.is_latched or any(ear[0] == self.entity.name for ear in ears)

    def put(self, payload, stamp):
        arrived = Arrived(payload, self.entity.gid)
        self.kept.append(arrived)
        for other in self.middleware.others():
            for name, _, on_message in other.heard:
                if name == self.entity.name:
                    other.call(on_message, arrived)

    def close(self):
        self.hide()


class Request:
    def __init__(self, payload, settle):
        self.payload, self.settle = payload, settle

    def answer(self, payload, stamp):
        self.settle(payload)

    def refuse(self, reason):
        self.settle(LinkError(reason))


class Client:
    def __init__(self, middleware, entity):
        self.middleware, self.entity = middleware, entity

    async def ask(self, payload, stamp, timeout):
        answer = self.middleware.loop.create_future()

        def settle(outcome):
            if not answer.done():
                is_refusal = isinstance(outcome, Exception)
                (answer.set_exception if is_refusal else answer.set_result)(outcome)

        for other in self.middleware.others():
            if self.entity.name in other.servers:
                other.call(other.servers[self.entity.name], Request(payload, settle))
                return await answer
        raise LinkError("no server")

    def close(self):
        pass


class MemoryReach(Reach):
    """Reach of the middlewares in this process."""

    def join(self, options):
        return MemoryMiddleware(options)
