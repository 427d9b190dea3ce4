"""Sweeps: many designs certified on Dask, their results in SQLite, a report (docs/sweeps.md).

    swept = veritrack.sweep("sweep.toml", jobs=4)            # or a base design and its axes
    swept.counts, swept.columns(), swept.verify(sample=100)

`veritrack.sweep(...)` is `veritrack.sweep.sweep(...)`, which type checkers know. In parts:

    spec = veritrack.sweep.read_spec("sweep.toml")
    with contextlib.closing(veritrack.sweep.Store("results.sqlite")) as store:
        veritrack.sweep.run_sweep(spec, store)
        veritrack.sweep.write_report(spec, store, "report")
        veritrack.sweep.recheck(spec, store, sample=100).verified
"""

from __future__ import annotations

import sys
import types
from typing import Any

from .reading import read_spec, spec_from_toml, spec_of
from .recheck import Recheck, recheck
from .spec import Axis, Point, Spec
from .store import Result, Row, Store, StoreError
from .whole import Swept, sweep

__all__ = ["Axis", "Options", "Point", "Recheck", "Result", "Row", "Spec", "Store", "StoreError", "Swept",
           "read_spec", "recheck", "run_sweep", "spec_from_toml", "spec_of", "sweep", "write_report"]


def __getattr__(name: str) -> Any:
    """Dask and Matplotlib take seconds to import, and a worker needs neither of them."""
    if name in ("Options", "run_sweep"):
        from . import run

        return getattr(run, name)
    if name == "write_report":
        from .report import write_report

        return write_report
    raise AttributeError(f"module {__name__} has no attribute {name}")


class _CallableModule(types.ModuleType):
    def __call__(self, *arguments: Any, **options: Any) -> Swept:
        return sweep(*arguments, **options)


sys.modules[__name__].__class__ = _CallableModule
