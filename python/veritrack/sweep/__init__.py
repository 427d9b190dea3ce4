"""Sweeps: many designs certified on Dask, their results in SQLite, a report (docs/sweeps.md).

    spec = veritrack.sweep.read_spec("sweep.toml")
    with contextlib.closing(veritrack.sweep.Store("results.sqlite")) as store:
        veritrack.sweep.run_sweep(spec, store)
        veritrack.sweep.write_report(spec, store, "report")
        veritrack.sweep.recheck(spec, store, sample=100).verified
"""

from __future__ import annotations

from typing import Any

from .recheck import Recheck, recheck
from .spec import Axis, Point, Spec, read_spec, spec_from_toml
from .store import Result, Row, Store, StoreError

__all__ = ["Axis", "Options", "Point", "Recheck", "Result", "Row", "Spec", "Store", "StoreError", "read_spec",
           "recheck", "run_sweep", "spec_from_toml", "write_report"]


def __getattr__(name: str) -> Any:
    """Dask and Matplotlib take seconds to import, and a worker needs neither of them."""
    if name in ("Options", "run_sweep"):
        from . import run

        return getattr(run, name)
    if name == "write_report":
        from .report import write_report

        return write_report
    raise AttributeError(f"module {__name__} has no attribute {name}")
