"""What a sweep costs beside certificates: designs a second when certificates take no time.

    PYTHONPATH=build/release/python /usr/bin/python3 bench/sweep_overhead.py 2000 1 2 4    (designs, then worker processes)

Engines are replaced by the stand-in of the tests, which answers at once. docs/scale.md has numbers.
"""

import contextlib
import os
import pathlib
import resource
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "python"))


def main():
    count, *workers = map(int, sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        programs = pathlib.Path(folder, "programs")
        programs.mkdir()
        (programs / "veritrack-engine").symlink_to(ROOT / "tests" / "python" / "stand_in_engine.py")
        os.environ["VERITRACK_PROGRAMS"] = str(programs)

        from conftest import TEXT
        from veritrack import sweep

        pathlib.Path(folder, "base.toml").write_text(TEXT)
        spec = sweep.spec_from_toml(
            f'name = "overhead"\nbase = "base.toml"\n[[axis]]\nkeys = ["design.q1"]\nrange = [0.001, 1]\npoints = {count}\n',
            f"{folder}/sweep.toml")
        for processes in workers:
            path = pathlib.Path(folder, f"{processes}.sqlite")
            with contextlib.closing(sweep.Store(path)) as store:
                reported = []
                start = time.perf_counter()
                sweep.run_sweep(spec, store, sweep.Options(jobs=processes),
                                lambda done, size, rate: reported.append((time.perf_counter() - start, done)))
            first = next(entry for entry in reported if entry[1] > 0)  # the cluster has started by then
            rate = (reported[-1][1] - first[1]) / max(reported[-1][0] - first[0], 1e-9)
            print(f"{processes} worker processes: {rate:.0f} designs/s, "
                  f"{path.stat().st_size / reported[-1][1]:.0f} bytes a design, "
                  f"client at most {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MiB")


if __name__ == "__main__":
    main()
