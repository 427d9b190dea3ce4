"""Sweeps: specifications, and results that survive whatever is killed."""

import contextlib
import csv
import dataclasses
import itertools
import json
import math
import os
import pathlib
import re
import resource
import signal
import sqlite3
import subprocess
import sys

import numpy as np
import pytest

import veritrack
from veritrack import _engine, sweep
from veritrack.sweep import __main__ as main
from veritrack.sweep import figures
from veritrack.sweep import run as runs
from veritrack.sweep import work
from veritrack.sweep.shown import pareto_front
from conftest import ROOT, TEXT

SPEC = """\
name = "a sweep"
base = "base.toml"

[[axis]]
keys = ["design.q1", "design.q2"]
log_range = [1e-4, 1]
points = 9

[[axis]]
keys = ["design.r"]
values = [0.1, 1, 10]
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "base.toml").write_text(TEXT)
    return tmp_path


@pytest.fixture
def stand_in(tmp_path_factory, monkeypatch):
    """Engines that answer at once."""
    programs = tmp_path_factory.mktemp("programs")
    (programs / "veritrack-engine").symlink_to(pathlib.Path(__file__).parent / "stand_in_engine.py")
    (programs / "veritrack-verify").symlink_to(_engine.program("veritrack-verify"))
    monkeypatch.setenv("VERITRACK_PROGRAMS", str(programs))
    _engine._pool.kill_idle()
    yield
    _engine._pool.kill_idle()


def read(folder, text=SPEC):
    (folder / "sweep.toml").write_text(text)
    return sweep.read_spec(folder / "sweep.toml")


# ---- specifications

def test_points_are_those_of_the_axes_the_last_one_first(folder, stand_in):
    spec = read(folder)
    assert spec.size == 27
    points = list(spec.points(0, 27))
    expected = itertools.product([f"{10 ** (k / 2 - 4):.6g}" for k in range(9)], ["0.1", "1", "10"])
    for point, (q, r) in zip(points, expected, strict=True):
        design = veritrack.Design.from_toml(point.text).values["design"]
        assert (float(design["q1"]), design["q1"]) == (pytest.approx(float(q), rel=1e-5), design["q2"])
        assert str(design["r"]) == r
    assert list(spec.points(5, 9)) == points[5:9]


@pytest.mark.parametrize("method", ["sobol", "random"])
def test_samples_are_the_same_wherever_one_begins(folder, stand_in, method):
    text = SPEC.replace("points = 9\n", "") + f'\n[samples]\ncount = 40\nmethod = "{method}"\nseed = 7\n'
    spec = read(folder, text)
    assert spec.size == 120
    points = list(spec.points(0, 120))
    assert [list(spec.points(k, k + 1))[0] for k in range(0, 120, 7)] == points[::7]
    values = np.array([float(point.values[0]) for point in points[::3]])
    assert len(set(values)) == 40 and (values >= 1e-4).all() and (values <= 1).all()
    # As many in each quarter of the range, about: logarithmic.
    assert np.histogram(np.log10(values), [-4, -3, -2, -1, 0])[0].min() >= 3


@pytest.mark.parametrize("change, place, words", [
    (("points = 9", "points = 1"), (7, 1), "a whole number from 2"),
    (("log_range = [1e-4, 1]", "log_range = [0, 1]"), (6, 1), "two numbers above 0"),
    (('keys = ["design.r"]', 'keys = ["r"]'), (10, 1), "a list of keys"),
    (('keys = ["design.r"]', 'keys = ["design.q1"]'), (10, 1), "in two axes"),
    (('name = "a sweep"', 'names = "a sweep"'), (1, 1), "unknown key names"),
    (("values = [0.1, 1, 10]", "values = [0.1, 1, 10]\nrange = [1, 2]"), (9, 1), "needs one of"),
    (("points = 9\n", ""), (0, 0), "[samples]"),
    (("values = [0.1, 1, 10]", "values = [0.1, 1, 10"), (12, 1), ""),
])
def test_what_is_wrong_with_a_specification_has_its_place(folder, stand_in, change, place, words):
    with pytest.raises(veritrack.InputError) as error:
        read(folder, SPEC.replace(*change))
    assert (error.value.line, error.value.column) == place or not words
    assert words in str(error.value)


def test_ten_million_points_are_never_in_memory(folder, stand_in):
    text = SPEC.replace("points = 9", "points = 10000").replace(
        "values = [0.1, 1, 10]", "range = [0.1, 10]\npoints = 1000")
    spec = read(folder, text)
    assert spec.size == 10**7
    with contextlib.closing(sweep.Store(folder / "results.sqlite")) as store:
        made = 0

        def counted(first, last):
            nonlocal made
            made += last - first
            return type(spec).points(spec, first, last)

        object.__setattr__(spec, "points", counted)
        taken = list(itertools.islice(runs._batches(spec, store, "program", False, lambda: 7, lambda points: None), 20))
        assert [point[0] for batch in taken for point in batch.points] == list(range(140))
        assert made <= 1000


# ---- runs

def results(folder):
    """(point, key, verdict, bounds) of all rows, and that nothing is there twice."""
    with contextlib.closing(sqlite3.connect(folder / "results.sqlite")) as file:
        assert file.execute("PRAGMA integrity_check").fetchone() == ("ok",)
        return file.execute("SELECT point, key, verdict, bounds FROM points JOIN results USING (key) "
                            "ORDER BY point").fetchall()


def run(folder, spec, progress=None, **options):
    with contextlib.closing(sweep.Store(folder / "results.sqlite")) as store:
        return sweep.run_sweep(spec, store, sweep.Options(jobs=1, **options), progress)


def assert_is_complete(folder, spec):
    rows = results(folder)
    assert [row[0] for row in rows] == list(range(spec.size))
    for point, (_, key, verdict, bounds) in zip(spec.points(0, spec.size), rows, strict=True):
        q1, r = float(point.values[0]), float(point.values[1])
        assert key == spec.key(point.text, _engine.identity())
        assert verdict == ("proved" if q1 * r < 0.5 else "undecided")
        assert float.fromhex(json.loads(bounds)["frequency_error_bound"][1]) == q1 * r


def test_a_worker_that_is_killed_loses_nothing_and_a_second_run_does_nothing(folder, stand_in):
    spec = read(folder)
    killed = []

    def kill_a_worker(done, size, rate):
        if done >= 3 and not killed:
            killed.append(_worker())
            os.kill(killed[0], signal.SIGKILL)

    assert run(folder, spec, kill_a_worker) >= 27
    assert killed
    assert_is_complete(folder, spec)
    before = results(folder)
    told = []
    assert run(folder, spec, lambda *progress: told.append(progress[:2])) == 0
    assert told == [(27, 27)] and results(folder) == before


def _worker():
    """The process of a Dask worker of this process."""
    for child in pathlib.Path(f"/proc/{os.getpid()}/task").glob("*/children"):
        for pid in child.read_text().split():
            command = pathlib.Path(f"/proc/{pid}/cmdline").read_bytes()
            if b"spawn_main" in command:
                return int(pid)
    raise AssertionError("no worker")


def test_another_sweep_takes_what_is_known_and_another_program_takes_nothing(folder, stand_in, monkeypatch):
    assert run(folder, read(folder)) == 27
    finer = read(folder, SPEC.replace("values = [0.1, 1, 10]", "values = [0.1, 0.5, 1, 10]"))
    assert run(folder, finer) == 9
    monkeypatch.setenv("STAND_IN_VERSION", "2")
    _engine._pool.kill_idle()
    assert run(folder, finer) == 36


def test_a_design_that_crashes_or_is_none_is_a_row_of_its_own(folder, stand_in):
    spec = read(folder, SPEC.replace("log_range = [1e-4, 1]\npoints = 9", "values = [0.001, 0.666, -1]"))
    assert run(folder, spec) == 9
    with contextlib.closing(sweep.Store(folder / "results.sqlite")) as store:
        rows = list(store.rows(spec.identity(_engine.identity())))
        assert [row.result.verdict for row in rows] == 3 * ["proved"] + 6 * ["error"]
        assert "signal 6" in rows[3].result.error and rows[3].result.may_be_tried_again
        assert "q1 below 0" in rows[6].result.error and not rows[6].result.may_be_tried_again
    assert run(folder, spec) == 0
    assert run(folder, spec, again=True) == 3
    with contextlib.closing(sweep.Store(folder / "results.sqlite")) as store:
        found = sweep.recheck(spec, store)
        assert not found.verified and len(found.objections) == 3  # what the stand-in writes is no certificate


def command(folder, *arguments, **options):
    return [sys.executable, "-m", "veritrack.sweep", *arguments, str(folder / "sweep.toml"), "--out", str(folder)]


def test_a_client_that_is_killed_goes_on_where_it_was(folder, stand_in):
    spec = read(folder, SPEC.replace("points = 9", "points = 400"))
    client = subprocess.Popen([*command(folder, "run"), "--jobs", "1"], stdout=subprocess.DEVNULL)
    before = []
    while len(before) < 5:
        assert client.poll() is None, "it ended before it could be killed"
        with contextlib.suppress(sqlite3.Error):
            before = results(folder)
    client.kill()
    client.wait()
    before = results(folder)
    assert 5 <= len(before) < spec.size
    left = spec.size - len(before)
    assert run(folder, spec) == left
    assert_is_complete(folder, spec)
    assert set(before) <= set(results(folder))


def test_a_full_disk_ends_the_run_and_harms_nothing(folder, stand_in):
    spec = read(folder, SPEC.replace("points = 9", "points = 100"))
    full = subprocess.run([*command(folder, "run"), "--jobs", "1"], capture_output=True, text=True, check=False,
                          env={**os.environ, "VERITRACK_SWEEP_MOST_PAGES": "14"})
    assert full.returncode == 2
    assert full.stderr.splitlines()[0] == f"veritrack sweep: {folder}/results.sqlite: database or disk is full"
    before = results(folder)
    assert 0 < len(before) < spec.size
    assert run(folder, spec) == spec.size - len(before)
    assert_is_complete(folder, spec)


def test_a_file_that_the_system_lets_grow_no_more_ends_the_run_and_harms_nothing(folder, stand_in):
    # The kernel refuses the write here (EFBIG), and not SQLite its own limit: what a full disk does in a program.
    spec = read(folder, SPEC.replace("points = 9", "points = 100"))
    most = 80_000
    full = subprocess.run([*command(folder, "run"), "--jobs", "1"], capture_output=True, text=True, check=False,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)))
    assert full.returncode == 2
    assert re.match(rf"veritrack sweep: {folder}/results.sqlite: (disk I/O error|database or disk is full)",
                    full.stderr.splitlines()[0])
    before = results(folder)
    assert 0 < len(before) < spec.size
    assert run(folder, spec) == spec.size - len(before)
    assert_is_complete(folder, spec)
    assert set(before) <= set(results(folder))


def test_a_full_file_system_ends_the_run_and_harms_nothing(folder, stand_in):
    spec = read(folder, SPEC.replace("points = 9", "points = 100"))
    # A file system of 160 KiB of its own (ENOSPC), which sees the package and the specification from outside.
    small = folder / "small"
    small.mkdir()
    mount = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c",
             'mount -t tmpfs -o size=160k tmpfs "$0" && shift 0 && "$@"; status=$?; cp "$0"/results.sqlite* "$OUTSIDE"; exit $status',
             str(small)]
    environment = {**os.environ, "OUTSIDE": str(folder)}
    if subprocess.run([*mount[:-2], 'mount -t tmpfs -o size=160k tmpfs "$0"', str(small)], capture_output=True,
                      check=False).returncode != 0:
        pytest.skip("this system lets nobody mount a file system of his own")
    full = subprocess.run([*mount, sys.executable, "-m", "veritrack.sweep", "run", str(folder / "sweep.toml"), "--out",
                           str(small), "--jobs", "1"], capture_output=True, text=True, check=False, env=environment)
    assert full.returncode == 2, full.stderr
    assert f"veritrack sweep: {small}/results.sqlite: database or disk is full" in full.stderr
    before = results(folder)
    assert 0 < len(before) < spec.size
    assert run(folder, spec) == spec.size - len(before)
    assert_is_complete(folder, spec)


def test_a_batch_is_stored_as_a_whole_or_not_at_all(folder):
    with contextlib.closing(sweep.Store(folder / "results.sqlite")) as store:
        good = sweep.Result("a", "proved", {})
        with pytest.raises(sweep.StoreError):
            store.add("s", [(0, "a", ()), (1, None, ())], [good])
        assert store.known_keys(["a"]) == set() and store.count("s") == 0
        assert store.add("s", [(0, "a", ())], [good]) == 1
        assert store.add("s", [(0, "a", ()), (1, "a", ())], [sweep.Result("a", "refuted", {})]) == 1
        assert [row.result.verdict for row in store.rows("s")] == ["proved", "proved"]


# ---- reports

def test_the_front_is_what_no_design_beats_in_both():
    random = np.random.default_rng(3)
    pairs = [(int(a), int(b)) for a, b in random.integers(0, 12, (60, 2))]
    rows = [sweep.Row(i, (), sweep.Result(str(i), "proved", {
        "cost": [float(a).hex(), float(a).hex(), "at most", "", ""],
        "gain": [float(b).hex(), float(b).hex(), "at least", "", ""]})) for i, (a, b) in enumerate(pairs)]

    class Asked:
        report = {"pareto": ["cost", "gain"]}

    front = {row.number for row in pareto_front(Asked, rows).front}
    for number, (a, b) in enumerate(pairs):
        is_beaten = any((c <= a and d >= b) and (c, d) != (a, b) for c, d in pairs)
        assert not (is_beaten and number in front)
    assert {pairs[number] for number in front} == {
        (a, b) for a, b in pairs if not any((c <= a and d >= b) and (c, d) != (a, b) for c, d in pairs)}


def test_certified_reported_and_verified_from_the_command_line(folder):
    spec = read(folder, """\
name = "four designs"
base = "base.toml"
record = ["frequency_error_bound", "largest_slew"]

[[axis]]
keys = ["design.q1", "design.q2"]
values = [0.001, 0.002]

[[axis]]
keys = ["design.r"]
values = [0.01]

[report]
bound = "frequency_error_bound"
level = 0.0057
pareto = ["frequency_error_bound", "largest_slew"]
""")
    done = subprocess.run([os.environ["VERITRACK"], "sweep", *command(folder)[3:], "--jobs", "2"],
                          capture_output=True, text=True, check=False,
                          env={**os.environ, "VERITRACK_PYTHON": sys.executable})
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == f"{folder}/report.md: 2 of 2 designs are PROVED to do all that is required\n"
    text = (folder / "report.md").read_text()
    assert "| PROVED | 2 |" in text and "(figures/regions.svg)" in text
    page = (folder / "report.html").read_text()
    assert not any("<image" in figure.read_text() for figure in folder.glob("figures/*.svg"))  # pages drop them
    assert "Certified bound over the designs" in page and "Designs by two bounds" in page and page.count("<svg") >= 2
    with open(folder / "results.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["design.q2"] for row in rows] == ["0.001", "0.002"]
    certificate = veritrack.certify(veritrack.Design.from_toml(next(spec.points(1, 2)).text, "base.toml"),
                                    figures=False, extent="requirements")
    assert rows[1]["certificate_sha256"] == certificate.sha256
    bound = certificate.bounds["frequency_error_bound"]
    assert float(rows[1]["frequency_error_bound hi"]) >= bound.hi
    # The same results, the same bytes.
    files = {path: path.read_bytes() for path in folder.rglob("*") if path.suffix in (".md", ".html", ".csv", ".svg")}
    assert subprocess.run(command(folder, "report"), check=True, capture_output=True).returncode == 0
    assert files == {path: path.read_bytes() for path in files}

    checked = subprocess.run(command(folder, "verify"), capture_output=True, text=True, check=False)
    assert (checked.returncode, checked.stdout) == (0, "VERIFIED: 2 of 2 rows\n")
    with contextlib.closing(sqlite3.connect(folder / "results.sqlite")) as file, file:
        bounds, = file.execute("SELECT bounds FROM results JOIN points USING (key) WHERE point = 1").fetchone()
        forged = json.loads(bounds)
        forged["frequency_error_bound"][:2] = [(1e-6).hex()] * 2
        file.execute("UPDATE results SET bounds = ? WHERE key = (SELECT key FROM points WHERE point = 1)",
                     (json.dumps(forged),))
    checked = subprocess.run(command(folder, "verify"), capture_output=True, text=True, check=False)
    assert checked.returncode == 1
    assert checked.stdout == "point 1: the bounds are others\nNOT VERIFIED: 1 of 2 rows\n"


def test_nothing_is_not_verified(folder, stand_in):
    read(folder)
    checked = subprocess.run(command(folder, "verify"), capture_output=True, text=True, check=False)
    assert (checked.returncode, checked.stdout) == (1, "NOT VERIFIED: no row with a verdict\n")


# ---- what is told of a specification before the first design

def test_the_examples_of_the_documentation_are_specifications(folder):
    sizes = {path.name: sweep.read_spec(path).size for path in (ROOT / "docs/example/sweep").glob("*.toml")
             if "base = " in path.read_text()}
    assert sizes == {"17-db.toml": 88, "lowest-snr.toml": 5, "many.toml": 10000, "slew.toml": 130}


REPORT = SPEC + '\n[report]\nbound = "frequency_error_bound"\n'


@pytest.mark.parametrize("text, words, line", [
    (REPORT + 'level = "x"\n', "level = 'x'; allowed: a number", 15),
    (REPORT + 'pareto = ["a"]\n', "pareto; allowed: the names of two bounds", 15),
    (REPORT + 'pareto = ["a", "a"]\n', "pareto; allowed: the names of two bounds", 15),
    (REPORT.replace('"frequency_error_bound"', "3"), "bound = 3; allowed: the name of a bound", 14),
    ('record = ["frequency_error_bounds"]\n' + REPORT, "'frequency_error_bound' is not recorded", 15),
    (SPEC + "\n[[axis]]\nkeys = ['assume.noise.snr_db']\nvalues = [17]\n", "noise is no table of the design, but 0.001", 14),
    (SPEC + "\n[[axis]]\nkeys = ['design.q1.x']\nvalues = [17]\n", "is a part of design.q1, which has an axis", 14),
    (SPEC.replace("[0.1, 1, 10]", "[2020-01-01]"), "cannot stand in a design", 11),
    (SPEC.replace("[0.1, 1, 10]", "[nan]"), "finite", 11),
    (SPEC.replace("[1e-4, 1]", "[1e-4, nan]"), "two numbers above 0", 6),
    (SPEC.replace("points = 9", "points = true"), "a whole number from 2", 7),
    ("axis = [1]\nname = 'x'\nbase = 'base.toml'\n", "axis is no table", 0),
    ("require = 1\n" + SPEC, "require is no table", 1),
    ("report = 1\n" + SPEC, "report is no table", 0),
])
def test_a_slip_in_a_specification_is_told_before_the_first_design(folder, stand_in, text, words, line):
    with pytest.raises(veritrack.InputError, match="^" + str(folder)) as error:
        read(folder, text)
    assert words in error.value.message and (error.value.line == line or line == 0)


@pytest.mark.parametrize("base, spec, place, words", [
    # The base design has comments, which the designs of the sweep have not: its own lines count.
    ("# a comment\n\n" + TEXT.replace("slew = 0.0", "slew = -1.0"), SPEC, ("base.toml", 16, 8), "slew"),
    ("# a comment\n\n" + TEXT, SPEC.replace("[0.1, 1, 10]", "[-1, 1]"), ("sweep.toml", 10, 1), "design.r"),
    (TEXT, SPEC + "\n[require]\nfrequency_error_belo = 1\n", ("sweep.toml", 14, 1), "frequency_error_below"),
], ids=["base", "axis", "require"])
def test_an_error_in_the_designs_names_the_file_that_it_is_in(folder, base, spec, place, words):
    (folder / "base.toml").write_text(base)
    with pytest.raises(veritrack.InputError, match=words) as error:
        read(folder, spec)
    assert (pathlib.Path(error.value.file).name, error.value.line, error.value.column) == place


def test_a_row_without_a_design_has_the_key_and_no_line_that_nobody_has_seen(folder):
    spec = read(folder, SPEC.replace("[0.1, 1, 10]", "[1, -1]").replace("points = 9", "points = 2"))
    program = _engine.identity()
    point = next(spec.points(1, 2))
    result, = work.certified([("key", point.text)], "base.toml", "quick", (), program, None)
    assert result.verdict == "error" and result.error.endswith(" (at design.r: r = -1)")
    assert "base.toml" not in result.error


def test_a_name_that_no_design_has_is_told(folder, stand_in):
    spec = read(folder, 'record = ["frequency_eror_bound"]\n' + SPEC)
    run(folder, spec)
    told = subprocess.run(command(folder, "report"), capture_output=True, text=True, check=False)
    assert told.returncode == 0
    assert "veritrack sweep: no design has a bound called frequency_eror_bound; some bounds need" in told.stderr
    assert "No design has a bound called frequency\\_eror\\_bound" in (folder / "report.md").read_text()
    spec = read(folder, SPEC + '\n[report]\nbound = "frequency_eror_bound"\n')
    assert run(folder, spec) == 27  # what was recorded without the bound is no result of this sweep
    told = subprocess.run(command(folder, "report"), capture_output=True, text=True, check=False)
    assert "is it frequency_error_bound?" in told.stderr


def test_a_worker_with_another_program_is_refused(folder, stand_in):
    with pytest.raises(work.OtherProgram, match="another program than the client"):
        work.certified([("key", TEXT)], "base.toml", "quick", (), "another", None)
    spec = read(folder)
    with contextlib.closing(sweep.Store(folder / "results.sqlite")) as store:
        started = runs._Run(spec, store, sweep.Options(jobs=1), None)
        started._program = "another"  # as of a client that was installed anew meanwhile
        with pytest.raises(work.OtherProgram):
            started.run()
        assert store.count(spec.identity("another")) == 0


# ---- in one call

def test_a_sweep_in_one_call(folder, stand_in, monkeypatch):
    monkeypatch.chdir(folder)
    swept = veritrack.sweep("base.toml", {("design.q1", "design.q2"): np.array([0.1, 0.3]), "design.r": [1, 3]},
                            jobs=1, record=["frequency_error_bound"])
    assert (swept.counts, swept.certified, swept.is_complete) == ({"proved": 3, "undecided": 1}, 4, True)
    assert swept.folder == pathlib.Path("sweeps-out/sweep") and (swept.folder / "report.md").is_file()
    columns = swept.columns()
    assert columns["design.q2"].tolist() == [0.1, 0.1, 0.3, 0.3] and columns["design.r"].tolist() == [1, 3, 1, 3]
    assert columns["verdict"].tolist() == ["proved", "proved", "proved", "undecided"]
    np.testing.assert_array_equal(columns["frequency_error_bound"],
                                  [0.1, 0.1 * 3, 0.3, 0.3 * 3])
    assert not swept.verify(sample=1, jobs=1).verified  # what the stand-in writes is no certificate
    again = veritrack.sweep.sweep(swept.spec, report=False, folder=swept.folder)
    assert again.certified == 0 and again.counts == swept.counts
    with pytest.raises(TypeError, match="with axes"):
        veritrack.sweep(veritrack.Design.from_toml(TEXT))


# ---- figures

def test_the_figure_shows_verdicts_and_its_line_goes_around_what_is_proved(folder, stand_in):
    axes = [sweep.Axis(("a.x",), "x", (1, 2, 3)), sweep.Axis(("a.y",), "y", (1, 2))]
    values = figures.Values(np.array([1.0, 2, 3, 1, 2, 3]), np.array([1.0, 1, 1, 2, 2, 2]),
                            np.array([0.1, 0.2, np.nan, 0.3, np.nan, np.nan]),
                            np.array(["proved", "undecided", "undecided", "proved", "refuted", "error"]), "a bound",
                            True, np.zeros(6, bool))
    assert figures.is_met(values, None).tolist() == [True, False, False, True, False, False]
    assert figures.is_met(values, 0.2).tolist() == [True, True, False, False, False, False]
    drawn = figures.region_figure(values, *axes, None)
    assert drawn.count('id="patch_') > 0 and drawn.count("<pattern") == 3  # a hatching for each verdict without a bound
    assert "<pattern" not in figures.region_figure(
        dataclasses.replace(values, bound=np.arange(1.0, 7), verdict=np.full(6, "proved")), *axes, None)


def test_a_bound_of_an_early_stop_does_not_look_like_the_best_one():
    axes = [sweep.Axis(("a.x",), "x", (1, 2, 3)), sweep.Axis(("a.y",), "y", (1, 2))]
    values = figures.Values(np.array([1.0, 2, 3, 1, 2, 3]), np.array([1.0, 1, 1, 2, 2, 2]), np.arange(1.0, 7),
                            np.full(6, "proved"), "a bound", True, np.zeros(6, bool))
    for is_at_most in (True, False):
        full = dataclasses.replace(values, is_at_most=is_at_most)
        early = dataclasses.replace(full, early=np.ones(6, bool))
        mixed = dataclasses.replace(full, early=np.array([True] + 5 * [False]))
        drawn = [figures.region_figure(each, *axes, None) for each in (full, early, mixed)]
        assert ["<pattern" in figure for figure in drawn] == [False, True, True]
        assert len(set(drawn)) == 3
    # Elsewhere a marker of its own, and in a line and a front a white one.
    stopped = dataclasses.replace(values, early=np.array([True, False] * 3))
    some = [0, 1, 2, 4]  # no grid

    def scattered(each):
        columns = {name: getattr(each, name)[some] for name in ("x", "y", "bound", "verdict", "early")}
        return figures.region_figure(dataclasses.replace(each, **columns), *axes, None)

    for draw in (lambda each: figures.line_figure(each, axes[0], None), scattered):
        assert draw(values) != draw(stopped)
    assert figures.pareto_figure([1, 2], [2, 1], [True, True], [False, True], ("a", "b")) != figures.pareto_figure(
        [1, 2], [2, 1], [True, True], [False, False], ("a", "b"))


@pytest.mark.parametrize("extent, words", [
    ("everything", "everything that certificates have"),
    ("requirements", "and not what takes long"),
    ("verdicts", "a search stops as soon as it has what is required"),
    ("quick", "what is UNDECIDED here, another extent may prove"),
])
def test_the_page_names_its_extent_and_what_that_says_of_its_bounds(folder, stand_in, extent, words):
    # The stand-in leaves designs with a large q1*r undecided.
    text = SPEC.replace('base = "base.toml"', f'base = "base.toml"\nextent = "{extent}"')
    spec = read(folder, text + '\n[report]\nbound = "frequency_error_bound"\nlevel = 0.001\n')
    run(folder, spec)
    assert subprocess.run(command(folder, "report"), check=True, capture_output=True).returncode == 0
    report = (folder / "report.md").read_text()
    assert f'Extent "{extent}": ' in report and words in report
    with open(folder / "results.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    found = [row for row in rows if row["search"] == "stopped early"]
    proved = [row for row in rows if row["verdict"] == "proved"]
    expected = {"verdicts": len(proved), "quick": len(rows)}.get(extent, 0)
    assert 0 < len(proved) < len(rows) and len(found) == expected
    assert (f"The bounds of {expected} designs are those at which the search stopped" in report) == (expected > 0)
    assert ("The search stopped early for " in report) == (expected > 0)
    assert ("hatched and lighter than the scale" in report) == (expected > 0)


def test_a_design_that_the_time_limit_ended_is_told(folder, stand_in):
    spec = read(folder)
    rows = [sweep.Row(0, ("1", "1"), sweep.Result("k", "error", {}, error="stopped after 3 s"))]
    from veritrack.sweep.report import _extent_sentence
    assert _extent_sentence(spec, rows).endswith(" 1 design was ended by the time limit.")


# ---- progress

def test_progress_on_a_terminal_and_in_a_log(monkeypatch, capsys):
    now = [100.0]
    monkeypatch.setattr(main.time, "monotonic", lambda: now[0])
    line = main._ProgressLine(quiet=False)
    for seconds, done in ((1, 1), (29, 2), (30, 3), (31, 4), (59, 5), (61, 10), (400, 20)):
        now[0] = 100.0 + seconds
        line(done, 1000, done / seconds)
    line.clear()
    told = capsys.readouterr().err.splitlines()
    assert told == ["3 of 1000 designs, 0.1 a second, 2.8 h left", "10 of 1000 designs, 0.164 a second, 101 min left",
                    "20 of 1000 designs, 0.05 a second, 5.4 h left"]
    monkeypatch.setattr(main.sys.stderr, "isatty", lambda: True)
    line = main._ProgressLine(quiet=False)
    line(1, 10, 0.25)
    assert capsys.readouterr().err == "\r\x1b[K1 of 10 designs, 0.25 a second, 36 s left"
    main._ProgressLine(quiet=True)(1, 10, 0.25)
    assert capsys.readouterr().err == ""


def test_the_rate_is_that_of_this_run(folder, stand_in):
    spec = read(folder)
    told = []
    run(folder, spec, lambda done, size, rate: told.append((done, size, rate)))
    assert told[0][:2] == (0, 27) and told[0][2] == 0 and told[-1][:2] == (27, 27) and told[-1][2] > 0
    told.clear()
    run(folder, read(folder, SPEC.replace("[0.1, 1, 10]", "[0.1, 1, 10, 20]")),
        lambda done, size, rate: told.append((done, size, rate)))
    assert told[-1][:2] == (36, 36)
