"""Sweeps on Dask: batches out to workers, results into the store, and never more than a few batches in memory."""

from __future__ import annotations

import contextlib
import dataclasses
import itertools
import logging
import os
import time
from typing import Any, Callable, Iterator

import distributed

from .. import _engine
from ..errors import VeritrackError
from .spec import Point, Spec
from .store import Result, Store
from .work import OtherProgram, certified

_CHUNK = 500
"""Points whose texts are made at a time."""

_BATCH_SECONDS = 5.0
"""That a batch is to take: messages cost nothing then, and little is lost with a worker."""

_MOST_IN_BATCH = 200
_BATCHES_PER_THREAD = 2

_LOST = (OSError, TimeoutError, distributed.TimeoutError)
"""The errors of a call to a scheduler or a worker that is gone."""

Progress = Callable[[int, int, float], None]
"""Told points with a result, all points, and points a second since the start."""


@dataclasses.dataclass
class Batch:
    """Points on their way, and the designs to be certified for them."""

    points: list[tuple[int, str, tuple[Any, ...]]]
    items: list[tuple[str, str]]
    tries: int = 0


@dataclasses.dataclass(frozen=True)
class Options:
    """How a sweep is run.

    Attributes
    ----------
    jobs : int
        Worker processes of the cluster on this machine; 0: one for each core.
    scheduler : str
        Address of a scheduler, such as "tcp://10.0.0.1:8786", instead of such a cluster.
    timeout : float or None
        Seconds after which a design is stopped; it is then an error.
    again : bool
        Try again what failed before for reasons that are not the design's.
    patience : float
        Seconds to wait for a scheduler that has gone away.
    """

    jobs: int = 0
    scheduler: str = ""
    timeout: float | None = None
    again: bool = False
    patience: float = 300.0


class SchedulerLost(VeritrackError):
    """The scheduler has not come back; everything that came before is in the store."""


class _Cluster:
    """A connection to workers, made again when it is lost."""

    def __init__(self, options: Options) -> None:
        self._options = options
        self._cluster: distributed.LocalCluster | None = None
        if not options.scheduler:
            logging.getLogger("distributed").setLevel(logging.CRITICAL)  # the sweep reports what matters
            # Workers are processes with one thread: a design is worked on by an engine with one thread.
            self._cluster = distributed.LocalCluster(
                n_workers=options.jobs or len(os.sched_getaffinity(0)), threads_per_worker=1, processes=True,
                memory_limit=0, dashboard_address="127.0.0.1:0", silence_logs=logging.CRITICAL)
        self._client: distributed.Client | None = None

    def client(self) -> distributed.Client:
        """A client that is connected. Raises SchedulerLost."""
        end = time.monotonic() + self._options.patience
        while self._client is None or self._client.status != "running":
            self._drop_client()
            left = end - time.monotonic()
            if left <= 0:
                raise SchedulerLost(f"{self._address()}: no scheduler with a worker within {self._options.patience:g} s")
            try:
                self._client = distributed.Client(self._address(), timeout=min(left, 10.0))
                self._client.wait_for_workers(1, timeout=left)
            except _LOST:
                pass  # the attempt took its time, or the address refuses; the loop looks at the clock
        return self._client

    def _address(self) -> str:
        return self._cluster.scheduler_address if self._cluster is not None else self._options.scheduler

    def _drop_client(self) -> None:
        client, self._client = self._client, None
        if client is not None:
            with contextlib.suppress(*_LOST):  # what it would say goodbye to may be gone
                client.close(timeout=1)

    def close(self) -> None:
        self._drop_client()
        if self._cluster is not None:
            self._cluster.close(timeout=60)


def _batches(spec: Spec, store: Store, program: str, again: bool, size: Callable[[], int],
             noted: Callable[[int], None]) -> Iterator[Batch]:
    """The work that is left. Points whose design is known from elsewhere are stored as they are met, and `noted`."""
    sweep = spec.identity(program)
    waiting: list[Point] = []

    def batch(points: list[Point]) -> Batch:
        keyed = [(point, spec.key(point.text, program)) for point in points]
        return Batch([(point.number, key, point.values) for point, key in keyed],
                     list({key: point.text for point, key in keyed}.items()))

    for first in range(0, spec.size, _CHUNK):
        last = min(first + _CHUNK, spec.size)
        done = store.known_points(sweep, first, last, again)
        if len(done) == last - first:
            continue
        points = [point for point in spec.points(first, last) if point.number not in done]
        keys = [spec.key(point.text, program) for point in points]
        known = store.known_keys(keys, again)
        found = [(point.number, key, point.values) for point, key in zip(points, keys) if key in known]
        if found:
            noted(store.add(sweep, found, []))
        waiting += [point for point, key in zip(points, keys) if key not in known]
        while len(waiting) >= size():
            taken, waiting = waiting[:size()], waiting[size():]
            yield batch(taken)
    while waiting:
        taken, waiting = waiting[:size()], waiting[size():]
        yield batch(taken)


def _threads(client: distributed.Client) -> int:
    """Threads of the workers; none where the scheduler goes away while it is asked."""
    try:
        return sum(client.nthreads().values())
    except _LOST:
        return 0


class _Run:
    """A sweep on its way."""

    def __init__(self, spec: Spec, store: Store, options: Options, progress: Progress | None) -> None:
        self._spec = spec
        self._store = store
        self._options = options
        self._progress = progress
        self._program = _engine.identity()
        self._sweep = spec.identity(self._program)
        self._seconds = 0.0  # that designs took
        self._certified = 0
        self._in_flight: dict[distributed.Future, Batch] = {}
        self._to_repeat: list[Batch] = []
        self._numbers = itertools.count()

    def _batch_size(self) -> int:
        if self._certified == 0:
            return 1
        mean = max(self._seconds / self._certified, 1e-6)
        return max(1, min(_MOST_IN_BATCH, int(_BATCH_SECONDS / mean)))

    def run(self) -> int:
        """All that is left; how many designs were certified."""
        self._store.begin(self._sweep, self._spec.name, self._spec.text, self._spec.base.text, self._program)
        self._start = self._had_workers = time.monotonic()
        self._done = self._at_start = self._store.count(self._sweep)
        batches = _batches(self._spec, self._store, self._program, self._options.again, self._batch_size,
                           self._note)
        self._tell()
        first = next(batches, None)
        if first is None:
            return 0  # a cluster would take seconds
        self._to_repeat.append(first)
        last = None
        with contextlib.closing(_Cluster(self._options)) as cluster:
            while True:
                client = cluster.client()
                if client is not last:  # what another one waits for does not come
                    self._to_repeat += self._in_flight.values()
                    self._in_flight.clear()
                    last = client
                self._submit(client, batches)
                if not self._in_flight:
                    return self._certified
                self._wait(client)

    def _submit(self, client: distributed.Client, batches: Iterator[Batch]) -> None:
        threads = _threads(client)
        now = time.monotonic()
        if threads:
            self._had_workers = now
        elif now - self._had_workers > self._options.patience:
            raise SchedulerLost(f"no worker for {self._options.patience:g} s; the same command goes on from here")
        most = max(_BATCHES_PER_THREAD, _BATCHES_PER_THREAD * threads)
        while len(self._in_flight) < most:
            if self._to_repeat:
                batch = self._to_repeat.pop()
            elif (left := next(batches, None)) is not None:
                batch = left
            else:
                return
            future = client.submit(
                certified, batch.items, self._spec.base.file, self._spec.extent, self._spec.record, self._program,
                self._options.timeout, pure=False, key=f"veritrack-{self._sweep[:12]}-{next(self._numbers)}")
            self._in_flight[future] = batch

    def _wait(self, client: distributed.Client) -> None:
        """Until a batch is done or has failed, or the scheduler is gone; all that is known is taken."""
        try:
            distributed.wait(list(self._in_flight), timeout=1.0, return_when="FIRST_COMPLETED")
        except (TimeoutError, distributed.TimeoutError, distributed.CancelledError):
            pass
        is_connected = client.status == "running"
        for future in [each for each in self._in_flight if each.status != "pending" or not is_connected]:
            batch = self._in_flight.pop(future)
            if future.status == "finished" and is_connected:
                self._take(batch, future)
            elif future.status == "error":
                self._fail(batch, future.exception())
            else:
                self._to_repeat.append(batch)  # lost with the scheduler
        self._tell()

    def _take(self, batch: Batch, future: distributed.Future) -> None:
        try:
            results = future.result(timeout=60)
        except (*_LOST, distributed.CancelledError):
            self._to_repeat.append(batch)  # the worker that had them is gone
            return
        self._keep(batch, results)

    def _keep(self, batch: Batch, results: list[Result]) -> None:
        self._note(self._store.add(self._sweep, batch.points, results))
        self._certified += len(results)
        self._seconds += sum(result.seconds for result in results)

    def _fail(self, batch: Batch, error: BaseException | None) -> None:
        """A batch whose workers ended, each in turn, is divided, so that a design that ends them is found."""
        if isinstance(error, OtherProgram):
            raise error
        if not isinstance(error, distributed.KilledWorker):
            raise VeritrackError(f"a worker failed: {error!r}")
        if len(batch.items) > 1:
            for key, text in batch.items:
                self._to_repeat.append(Batch([point for point in batch.points if point[1] == key], [(key, text)]))
        elif batch.tries == 0:
            self._to_repeat.append(dataclasses.replace(batch, tries=1))
        else:
            self._keep(batch, [Result(batch.items[0][0], "error", {}, error="its workers ended, each in turn",
                                      may_be_tried_again=True)])

    def _note(self, points: int) -> None:
        self._done += points

    def _tell(self) -> None:
        if self._progress is not None:
            elapsed = max(time.monotonic() - self._start, 1e-9)
            self._progress(self._done, self._spec.size, (self._done - self._at_start) / elapsed)


def run_sweep(spec: Spec, store: Store, options: Options = Options(), progress: Progress | None = None) -> int:
    """Certifies all designs of a sweep that the store does not have yet.

    Whatever is killed meanwhile: what was stored stays, the same call again does the rest, and no result is
    there twice.

    Parameters
    ----------
    spec : Spec
    store : Store
    options : Options
    progress : callable, optional
        Told points with a result, all points, and points a second since the start, now and then.

    Returns
    -------
    int
        How many designs were certified by this call.

    Raises
    ------
    SchedulerLost, StoreError, OtherProgram
    """
    return _Run(spec, store, options, progress).run()
