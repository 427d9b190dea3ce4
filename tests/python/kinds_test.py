"""What a certificate says in Python, for each kind of tracker."""

import re

import numpy as np
import pytest

import veritrack
from conftest import ROOT

# A design of each kind that takes seconds, with bounds, and kinds of sets, that it has to have.
KINDS = {
    "quadrature-ekf": ("la-scala-1994-figure-3.5-at-17-db.toml", {"probability_of_losing_lock": "at most"}, {"lock"}),
    "single-channel-ekf": ("bittanti-savaresi-2000-example-1-quiet.toml", {"frequency_error_bound": "at most"},
                           {"contraction"}),
    "kkl-observer": ("praly-section-v-proved-ell.toml", {"frequency_error_bound": "at most"}, set()),
    "model": ("models/type-2-pll.toml", {"frequency_error": "at most", "noise": "at least"}, {"tubes"}),
    "vibration-regulator": ("regulator/thesis-example.toml", {"output_bound": "at most",
                                                              "ultimate_attenuation": "at least"},
                            {"frequency_tracker/contraction"}),
    "dft-block-ekf": ("block/la-scala-1994-set-1.toml", {"offset_error_bound": "at most",
                                                         "settling_blocks": "at most"},
                      {"lock-set"}),
}


def test_each_kind_of_tracker_is_tested():
    columns = re.findall(r"VERITRACK_TRACKER\((\w+)\)", (ROOT / "certificates/trackers.def").read_text())
    assert len(columns) == len(KINDS) > 0
    assert all(f'"{kind}"' in veritrack.Design.__doc__ for kind in KINDS)


@pytest.mark.parametrize("kind", KINDS)
def test_bounds_and_sets_of_each_kind(kind):
    path, senses, kinds = KINDS[kind]
    design = veritrack.Design.from_file(ROOT / "designs" / path)
    assert design.tracker == kind
    if kind == "model":
        design = design.replace({"assume.frequency": [0.3, 0.32]})  # seconds in place of minutes
    certificate = veritrack.certify(design, extent="verdicts", figures=False, timeout=600)
    assert senses.items() <= {name: bound.sense for name, bound in certificate.bounds.items()}.items()
    assert all(bound.lo <= bound.hi and bound.value in bound for bound in certificate.bounds.values())
    assert kinds <= {each["kind"] for each in certificate.sets}
    assert all(each["purpose"] for each in certificate.sets)
    if kind == "quadrature-ekf":
        lock = next(each for each in certificate.sets if each["kind"] == "lock")
        written = certificate.json["lock_sets"][0]
        assert lock["metric"].shape == (3, 3) and lock["level"] == float.fromhex(written["level"])
        assert lock["metric"][2, 2] == float.fromhex(written["metric"][2][2])
    page = certificate._repr_html_()
    assert page.count("<tr><td") >= len(certificate.bounds) > 0


def test_check_has_the_bounds_of_a_block_tracker():
    checked, = veritrack.check([ROOT / "designs/block/la-scala-1994-set-1.toml"], extent="verdicts")
    assert checked.verdict == "proved" and checked.bounds["offset_error_bound"].claim == "dft-block/offset-error"
    with pytest.raises(ValueError, match="allowed: 'everything'"):
        veritrack.check([], extent="all")


def test_tubes_are_there_although_their_series_have_different_lengths():
    sets = veritrack.sets.sets_of({"tubes": [{"name": "assumed", "cells": [{"turns": [1, 0], "curve": [
        [[["0x1p0", "0x0p+0"]]], [[["0x1p0", "0x0p+0"]], [["0x1p1", "-0x1p0"], ["0x1p2", "0x0p+0"]]], []]}]}]})
    curve = sets[0]["cells"][0]["curve"]
    assert sets[0]["purpose"] == "assumed" and sets[0]["cells"][0]["turns"] == [1, 0]
    assert np.array_equal(curve[0], [[[1, 0]]]) and np.array_equal(curve[1][1], [[2, -1], [4, 0]]) and curve[2] == []
