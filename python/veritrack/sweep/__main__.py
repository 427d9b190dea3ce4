"""veritrack sweep: certifies all designs of a specification, reports on them, and has rows checked again."""

from __future__ import annotations

import argparse
import math
import os
import pathlib
import sys
import time

from ..errors import InputError, VeritrackError
from .reading import read_spec
from .spec import Spec
from .store import Store

_ALL_DONE, _NOT_ALL, _BAD_INPUT = 0, 1, 2
_INTERRUPTED = 130


class _ProgressLine:
    """Progress on standard error: a line that changes on a terminal, a line now and then in a log."""

    _ON_A_TERMINAL = 0.5
    _IN_A_LOG = 30.0
    """Seconds between two. The first one in a log comes after that long, too: short sweeps need none."""

    def __init__(self, quiet: bool) -> None:
        self._shown = not quiet
        self._is_terminal = sys.stderr.isatty()
        self._wait = self._ON_A_TERMINAL if self._is_terminal else self._IN_A_LOG
        self._last = -math.inf if self._is_terminal else time.monotonic()

    def __call__(self, done: int, size: int, rate: float) -> None:
        now = time.monotonic()
        if not self._shown or now - self._last < self._wait:
            return
        self._last = now
        left = f", {_duration((size - done) / rate)} left" if rate > 0 else ""
        line = f"{done} of {size} designs, {rate:.3g} a second{left}"
        print(f"\r\x1b[K{line}" if self._is_terminal else line, end="" if self._is_terminal else "\n", file=sys.stderr,
              flush=True)

    def clear(self) -> None:
        if self._shown and self._is_terminal:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)


def _duration(seconds: float) -> str:
    if seconds < 120:
        return f"{seconds:.0f} s"
    if seconds < 2 * 3600:
        return f"{seconds / 60:.0f} min"
    return f"{seconds / 3600:.1f} h"


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="veritrack sweep", description="Certifies many designs (docs/sweeps.md).",
        epilog="Exit status: 0 every design has a verdict (verify: every row that was looked at is verified); "
               "1 some do not; 2 bad input, or results that cannot be written.")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)

    def command(name: str, words: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=words, description=words)
        added.add_argument("spec", metavar="SPEC.toml", help="specification of the sweep")
        added.add_argument("--out", help="folder of the results (default: sweeps-out/<name of the specification>)")
        added.add_argument("--jobs", type=_count, default=0, help="designs at a time (default: one for each core)")
        added.add_argument("--quiet", action="store_true", help="no progress on standard error")
        return added

    run = command("run", "certify the designs that have no result yet, and report; may be left out")
    run.add_argument("--scheduler", default="", metavar="ADDRESS",
                     help="of a Dask scheduler, such as tcp://10.0.0.1:8786, instead of workers on this machine")
    run.add_argument("--timeout", type=_seconds, metavar="S", help="stop a design after S seconds")
    run.add_argument("--again", action="store_true", help="try again what was stopped or failed before")
    run.add_argument("--patience", type=_seconds, default=300.0, metavar="S",
                     help="wait S seconds for a scheduler that has gone away (default: 300)")
    command("report", "report on the results that there are")
    verify = command("verify", "make certificates again and have the independent checker prove them")
    verify.add_argument("--sample", type=_count, default=100, metavar="N", help="rows, drawn (default: 100)")
    verify.add_argument("--all", action="store_true", help="all rows")
    verify.add_argument("--seed", type=int, default=1, help="of the draw (default: 1)")
    return parser


def _count(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError("allowed: a whole number, 1 or more")
    return value


def _seconds(text: str) -> float:
    value = float(text)
    if not 1e-3 <= value <= 1e8:
        raise argparse.ArgumentTypeError("allowed: a number of seconds from 0.001 to 1e8")
    return value


def main(arguments: list[str] | None = None) -> int:
    words = list(sys.argv[1:] if arguments is None else arguments)
    if words and words[0] not in ("run", "report", "verify", "-h", "--help"):
        words.insert(0, "run")
    options = _parser().parse_args(words)
    try:
        return _answer(options)
    except KeyboardInterrupt:
        print("veritrack sweep: stopped; the same command goes on from here", file=sys.stderr)
        return _INTERRUPTED
    except ModuleNotFoundError as error:
        print(f"veritrack sweep: needs the module {error.name}: apt-get install python3-distributed "
              "python3-matplotlib python3-scipy, or pip install 'veritrack[sweep]'", file=sys.stderr)
        return _BAD_INPUT
    except (VeritrackError, OSError) as error:
        print(f"{error}" if isinstance(error, InputError) else f"veritrack sweep: {error}", file=sys.stderr)
        return _BAD_INPUT


def _answer(options: argparse.Namespace) -> int:
    spec = read_spec(options.spec)
    folder = pathlib.Path(options.out or pathlib.Path("sweeps-out", pathlib.Path(options.spec).stem))
    folder.mkdir(parents=True, exist_ok=True)
    store = Store(folder / "results.sqlite", int(os.environ.get("VERITRACK_SWEEP_MOST_PAGES", "0")))
    try:
        if options.command == "verify":
            return _verify(spec, store, options)
        if options.command == "run":
            _run(spec, store, options)
        return _report(spec, store, folder)
    finally:
        store.close()


def _run(spec: Spec, store: Store, options: argparse.Namespace) -> None:
    from .run import Options, run_sweep

    line = _ProgressLine(options.quiet)
    try:
        run_sweep(spec, store, Options(options.jobs, options.scheduler, options.timeout, options.again,
                                       options.patience), line)
    finally:
        line.clear()


def _report(spec: Spec, store: Store, folder: pathlib.Path) -> int:
    from .report import write_report
    from .shown import missing_bounds

    document = write_report(spec, store, folder)
    for sentence in missing_bounds(spec, store, _program()):
        print(f"veritrack sweep: {sentence}", file=sys.stderr)
    print(f"{document}: {document.read_text().splitlines()[0].lstrip('# ')}")
    sweep = spec.identity(_program())
    with_verdict = store.count(sweep) - store.count(sweep, "error")
    return _ALL_DONE if with_verdict == spec.size else _NOT_ALL


def _verify(spec: Spec, store: Store, options: argparse.Namespace) -> int:
    from .recheck import recheck

    line = _ProgressLine(options.quiet)
    start = time.monotonic()
    try:
        found = recheck(spec, store, sample=None if options.all else options.sample, seed=options.seed,
                        jobs=options.jobs or None,
                        progress=lambda done, size: line(done, size, done / max(time.monotonic() - start, 1e-9)))
    finally:
        line.clear()
    for number, objection in found.objections:
        print(f"point {number}: {objection}")
    if found.rows == 0:
        print("NOT VERIFIED: no row with a verdict")
        return _NOT_ALL
    verified = found.rows - len(found.objections)
    print(f"{'VERIFIED' if found.verified else 'NOT VERIFIED'}: {verified} of {found.rows} rows")
    return _ALL_DONE if found.verified else _NOT_ALL


def _program() -> str:
    from .. import identity

    return identity()


if __name__ == "__main__":
    sys.exit(main())
