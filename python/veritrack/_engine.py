"""The processes that certify (veritrack-engine), and a pool of them.

A certificate is computed in a process of its own. So Ctrl-C ends it at any moment, a crash does not take the
interpreter along, and the rounding modes of proofs never meet those of the interpreter.
"""

from __future__ import annotations

import atexit
import contextlib
import json
import os
import pathlib
import select
import subprocess
import threading
import time
from typing import Any, Iterator

from .errors import ArithmeticNotTrusted, EngineError, InputError, TimeLimit

def program(name: str) -> str:
    """The path of a program of the package; $VERITRACK_PROGRAMS names another folder with them."""
    folder = os.environ.get("VERITRACK_PROGRAMS") or pathlib.Path(__file__).parent / "bin"
    path = pathlib.Path(folder, name)
    if not path.is_file():
        raise EngineError(f"{path}: the program is missing; install the package (docs/python.md)")
    return str(path)


class Engine:
    """One process, which answers one request at a time."""

    def __init__(self) -> None:
        self._process = subprocess.Popen([program("veritrack-engine")], stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE, bufsize=0)
        self._unread = b""
        try:
            self.greeting = json.loads(self._line(None))
        except BaseException:
            self.kill()
            raise
        if self.greeting["failures"]:
            self.kill()
            raise ArithmeticNotTrusted("this machine or this build cannot be trusted with a certificate: "
                                       + "; ".join(self.greeting["failures"]))

    def is_alive(self) -> bool:
        return self._process.poll() is None

    def kill(self) -> None:
        """Ends the process at once. Callers that wait for its answer get an EngineError."""
        self._process.kill()
        self._process.wait()

    def request(self, question: dict[str, Any], limit: float | None = None) -> dict[str, Any]:
        """The answer. After `limit` seconds, or when it is interrupted, the process is killed."""
        try:
            self._send(json.dumps(question).encode() + b"\n")
            answer = json.loads(self._line(limit))
        except BaseException:
            self.kill()
            raise
        if "error" in answer:
            raise _exception(answer["error"])
        return answer

    def _send(self, line: bytes) -> None:
        assert self._process.stdin is not None
        try:
            view = memoryview(line)
            while view:
                view = view[os.write(self._process.stdin.fileno(), view):]
        except BrokenPipeError:
            raise EngineError(self._obituary()) from None

    def _line(self, limit: float | None) -> bytes:
        assert self._process.stdout is not None
        end = None if limit is None else time.monotonic() + limit
        parts = [self._unread]
        while b"\n" not in parts[-1]:
            left = None if end is None else max(0.0, end - time.monotonic())
            if not select.select([self._process.stdout], [], [], left)[0]:
                raise TimeLimit(f"stopped after {limit:g} s")
            part = os.read(self._process.stdout.fileno(), 1 << 20)
            if not part:
                raise EngineError(self._obituary())
            parts.append(part)
        line, self._unread = b"".join(parts).split(b"\n", 1)
        return line

    def _obituary(self) -> str:
        status = self._process.wait()
        how = f"by signal {-status}" if status < 0 else f"with status {status}"
        return f"the process that certifies ended {how}"


def _exception(error: dict[str, Any]) -> Exception:
    if error["kind"] == "input":
        return InputError(error["file"], error["line"], error["column"], error["message"])
    if error["kind"] == "arithmetic":
        return ArithmeticNotTrusted(error["message"])
    return EngineError(error["message"])


class _Pool:
    """Engines that wait for work."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._idle: list[Engine] = []

    def take(self) -> Engine:
        with self._lock:
            while self._idle:
                engine = self._idle.pop()
                if engine.is_alive():
                    return engine
        return Engine()

    def give_back(self, engine: Engine) -> None:
        if engine.is_alive():
            with self._lock:
                self._idle.append(engine)

    def kill_idle(self) -> None:
        with self._lock:
            idle, self._idle = self._idle, []
        for engine in idle:
            engine.kill()


class Crew:
    """The engines that work on something together, so that they can be ended together."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._at_work: set[Engine] = set()
        self._is_stopped = False

    def join(self, engine: Engine) -> None:
        with self._lock:
            self._at_work.add(engine)
            if self._is_stopped:
                engine.kill()

    def leave(self, engine: Engine) -> None:
        with self._lock:
            self._at_work.discard(engine)

    def stop(self) -> None:
        """Ends them; who waits for an answer gets an EngineError."""
        with self._lock:
            self._is_stopped = True
            for engine in self._at_work:
                engine.kill()


_pool = _Pool()


def _forget_engines() -> None:
    """After a fork: the pipes belong to the parent."""
    global _pool
    _pool = _Pool()


os.register_at_fork(after_in_child=_forget_engines)
atexit.register(lambda: _pool.kill_idle())


@contextlib.contextmanager
def engine(crew: Crew | None = None) -> Iterator[Engine]:
    """An engine for some requests."""
    pool = _pool
    taken = pool.take()
    if crew is not None:
        crew.join(taken)
    try:
        yield taken
    finally:
        if crew is not None:
            crew.leave(taken)
        pool.give_back(taken)


def ask(question: dict[str, Any], limit: float | None = None, crew: Crew | None = None) -> dict[str, Any]:
    """The answer of an engine to one request."""
    with engine(crew) as taken:
        return taken.request(question, limit)


def identity() -> str:
    """Which program certifies: the SHA-256 of the file, with its version and that of the library that rounds."""
    with engine() as taken:
        return taken.greeting["identity"]


def version() -> str:
    """The version of the program that certifies."""
    with engine() as taken:
        return taken.greeting["version"]
