"""Designs, certificates and the checker, as a user of the package meets them."""

import fractions
import json
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

import veritrack
from veritrack import _engine
from conftest import ROOT, TEXT


# ---- designs

def test_a_design_is_read_and_knows_its_places(design):
    assert (design.name, design.tracker) == ("a design", "quadrature-ekf")
    assert design.positions["design.q1"] == (5, 6)
    assert str(design.values["design"]["q1"]) == "0.0023"


@pytest.mark.parametrize("change, line, column, words", [
    ("q1 = 0.0023", 5, 1, "unknown key design.q3"),
    ("r = 0.05", 7, 1, "unknown key design.q3"),
])
def test_an_unknown_key_has_its_place(change, line, column, words):
    with pytest.raises(veritrack.InputError) as error:
        veritrack.Design.from_toml(TEXT.replace(change, "q3 = 1"), "folder/mine.toml")
    assert (error.value.file, error.value.line, error.value.column) == ("folder/mine.toml", line, column)
    assert words in error.value.message
    assert str(error.value).startswith(f"folder/mine.toml:{line}:{column}: ")
    assert pickle.loads(pickle.dumps(error.value)).line == line


def test_keywords_make_the_same_design_as_a_file(design):
    made = veritrack.Design("quadrature-ekf", "a design", **{
        name: table for name, table in design.values.items() if isinstance(table, dict)})
    assert made.values == design.values
    assert made == design.replace({})


def test_numbers_are_the_decimals_that_were_written(design):
    changed = design.replace({"design.q1": np.float64(0.1), "design.q2": 1e-7, "simulate": None})
    assert "q1 = 0.1\n" in changed.text and "q2 = 1e-07\n" in changed.text
    assert "simulate" not in changed.values
    with pytest.raises(ValueError, match="finite"):
        design.replace({"design.q1": float("nan")})


@pytest.mark.parametrize("path", sorted(ROOT.glob("designs/**/*.toml")), ids=lambda path: path.stem)
def test_every_design_survives_being_written(path):
    read = veritrack.Design.from_file(path)
    assert read.replace({}).values == read.values
    assert pickle.loads(pickle.dumps(read)) == read


# ---- certificates

def test_a_certificate_says_what_the_command_line_says(design, certificate, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(TEXT)
    subprocess.run([os.environ["VERITRACK"], "certify", "--no-verify", path, "--out", tmp_path / "out"], check=True,
                   capture_output=True)
    saved = certificate.save(tmp_path / "saved")
    assert saved == tmp_path / "saved" / "certificate.md"
    for name in [*certificate.files, *(f"figures/{figure.file}" for figure in certificate.figures())]:
        assert (tmp_path / "saved" / name).read_bytes() == (tmp_path / "out" / name).read_bytes(), name


def test_bounds_are_exact_and_only_of_what_is_proved(certificate):
    bound = certificate.bounds["frequency_error_bound"]
    assert certificate.verdict == "proved" and bound.sense == "at most" and bound.claim == "ekf/frequency-error-bound"
    lo, hi = bound.fractions
    assert fractions.Fraction(bound.lo) == lo <= hi < fractions.Fraction("0.05")
    assert fractions.Fraction(bound.upper()) >= hi and fractions.Fraction(bound.lower()) <= lo
    assert hi in bound and hi + 1 not in bound
    evidence = {claim["id"]: claim for claim in certificate.json["claims"]}[bound.claim]["evidence"]
    assert float.fromhex(evidence["frequency_error_bound"]["hi"]) == bound.hi
    proved = {claim.id for claim in certificate.claims if claim.verdict == "proved"}
    assert {each.claim for each in certificate.bounds.values()} <= proved


def test_nothing_that_is_not_proved_is_a_bound(design):
    claims = veritrack.certificate.claims_of({"claims": [
        {"id": name, "verdict": verdict, "statement": "", "requirement": "", "required": name == "ekf/asked",
         "reason": "", "line": 0, "column": 0,
         "quantities": {"x": {"lo": "0x1p0", "hi": value, "sense": sense, "words": "", "symbol": ""}}}
        for name, verdict, value, sense in [
            ("ekf/guarantee", "undecided", "0x1p1", "at most"), ("ekf/guarantee", "proved", "0x1p2", "at most"),
            ("ekf/limits", "refuted", "0x1p3", "at most"), ("ekf/asked", "proved", "0x1p4", "sampled"),
            ("theorem-2.9/printed", "proved", "0x1p5", "at most"), ("ekf/lowest-snr", "proved", "0x1p6", "at most"),
        ]]})
    bounds = veritrack.certificate.bounds_of(claims)
    assert {name: bound.hi for name, bound in bounds.items()} == {"ekf/lowest-snr/x": 64.0}


def test_what_is_shown_in_a_notebook(certificate):
    page = certificate._repr_html_()
    assert "PROVED" in page and "<table>" in page and "at most" in page
    tube = next(figure for figure in certificate.figures() if figure.file == "tube.svg")
    assert tube._repr_svg_().startswith("<?xml") or "<svg" in tube.svg
    assert len(tube.data()["sample"]) > 10
    assert certificate.sets[0]["metric"].shape == (3, 3)


def test_the_checker_verifies_and_a_changed_certificate_is_not_verified(certificate, tmp_path):
    found = certificate.verify()
    assert found and found.requirements_proved and not found.objections
    assert found.design_sha256 == certificate.design.sha256
    certificate.save(tmp_path)
    changed = json.loads(certificate.files["certificate.json"])
    bound = next(claim for claim in changed["claims"] if claim["id"] == "ekf/frequency-error-bound")["evidence"]
    bound["frequency_error_bound"]["hi"] = bound["frequency_error_bound"]["lo"] = "0x1p-12"
    (tmp_path / "certificate.json").write_text(json.dumps(changed))
    assert not veritrack.verify(tmp_path)
    (tmp_path / "certificate.json").write_text("{")
    with pytest.raises(veritrack.MalformedCertificate):
        veritrack.verify(tmp_path)


# ---- many designs

def test_check_keeps_the_order_and_a_bad_design_harms_no_other(design, tmp_path):
    found = veritrack.check([design, tmp_path / "missing.toml", design.replace({"assume.noise": 0.5}),
                             design.replace({"require.frequency_error_below": None})], jobs=2)
    assert [each.verdict for each in found] == ["proved", "error", "undecided", "nothing-required"]
    assert isinstance(found[1].error, OSError)
    assert found[0].bounds["frequency_error_bound"].hi < 0.05
    assert "frequency_error_bound" not in found[2].bounds


def test_a_time_limit_stops_a_design(design):
    checked, = veritrack.check([design], timeout=1e-3)
    assert isinstance(checked.error, veritrack.TimeLimit)
    with pytest.raises(veritrack.TimeLimit):
        veritrack.certify(design, timeout=1e-3)


# ---- the process that certifies

def test_a_process_that_is_killed_is_an_error_and_the_next_one_works(design):
    with _engine.engine() as engine:
        os.kill(engine._process.pid, signal.SIGKILL)
        with pytest.raises(veritrack.EngineError, match="signal 9"):
            engine.request({"do": "read", "text": TEXT, "file": "x"})
    assert veritrack.Design.from_toml(TEXT) == design


def test_what_is_no_request_is_refused():
    with pytest.raises(veritrack.EngineError, match="no request is called"):
        _engine.ask({"do": "something"})


_INTERRUPTED = """
import sys, veritrack
design = veritrack.Design.from_file(sys.argv[1])
try:
    print("begins", flush=True)
    veritrack.check([design] * 8, jobs=2) if sys.argv[2] == "check" else veritrack.certify(design)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.parametrize("what", ["certify", "check"])
def test_an_interrupt_ends_the_work(what):
    # A design that takes minutes: ending before that is what "at once" means here.
    slow = ROOT / "designs/la-scala-1994-figure-3.4-with-leak-at-22-db.toml"
    program = subprocess.Popen([sys.executable, "-c", _INTERRUPTED, slow, what], stdout=subprocess.PIPE, text=True)
    assert program.stdout.readline() == "begins\n"
    engines = []
    while not engines:  # until the work has begun
        engines = _children(program.pid)
    program.send_signal(signal.SIGINT)
    assert program.stdout.readline() == "interrupted\n"
    assert program.wait(timeout=60) == 0
    assert not any(pathlib.Path(f"/proc/{engine}").exists() for engine in engines)


def test_engines_end_with_a_program_that_is_killed():
    slow = ROOT / "designs/la-scala-1994-figure-3.4-with-leak-at-22-db.toml"
    program = subprocess.Popen([sys.executable, "-c", _INTERRUPTED, slow, "certify"], stdout=subprocess.PIPE, text=True)
    assert program.stdout.readline() == "begins\n"
    engines = []
    while not engines:
        engines = _children(program.pid)
    descriptors = [os.pidfd_open(engine) for engine in engines]
    program.kill()
    program.wait()
    for descriptor in descriptors:
        signal_or_end = threading.Event()
        threading.Thread(target=lambda d=descriptor: (_wait_for_end(d), signal_or_end.set()), daemon=True).start()
        assert signal_or_end.wait(60), "an engine outlives the program that asked it"
        os.close(descriptor)


def _wait_for_end(descriptor):
    import select
    select.select([descriptor], [], [])


def _children(pid):
    try:
        return [int(child) for task in pathlib.Path(f"/proc/{pid}/task").iterdir()
                for child in (task / "children").read_text().split()]
    except OSError:
        return []
