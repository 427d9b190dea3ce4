#!/usr/bin/env python3
"""Makes the certificates of accepted/ from a whole one: a certificate that states less is a certificate.

usage: trim.py CERTIFICATE.json theorem-2.9|published|repaired|contraction|one-set|capture|
               kkl-observer|kkl-paper|steady-state|frozen-filter|phases|steady-set > accepted/NAME.json

theorem-2.9   the two readings of Theorem 2.9 and their claims; no certified set
published     the published results and the places of the proof of Theorem 2.9; no certified set
repaired      the repaired theorem
contraction   all certified sets, the derivation "contraction" and the claims that rest on it
one-set       the same from the set that is checked fastest, for tests that check it hundreds of times
capture       farther starts, followed into the set of one-set: one box, of which little is said
kkl-observer  a KKL observer at one frequency with a sinusoidal disturbance, and an easier bound on the amplitude error
kkl-paper     its ell and the paper's claims
steady-state  of the single-channel tracker with a leak at one frequency (tests/certificates/steady-state.toml) and
              Proposition 1
frozen-filter that tracker's, alone
phases        the single-channel tracker's sets over all phases at one frequency
              (tests/certificates/phases.toml), and the claims that rest on them
steady-set    of the quadrature tracker with a leak in a narrow band (tests/certificates/steady-set.toml): the
              contraction with two levels, and the set for the largest noise
"""
import decimal
import json
import math
import sys


def keep(certificate, derivations, claims):
    certificate["derivations"] = [d for d in certificate["derivations"] if d["id"] in derivations]
    certificate["comparison"] = [row for row in certificate["comparison"] if row["result"] in derivations]
    certificate["claims"] = [claim for claim in certificate["claims"] if claim["id"] in claims]
    certificate["audits"] = []


def steady_set(certificate):
    """Fewer levels: what rests on the last ones is larger."""
    derivation = certificate["derivations"][0]
    drop_unproved(derivation)
    derivation["evidence"] = [e for e in derivation["evidence"] if e["name"] != "largest-slew"]
    numbers = derivation["evidence"][0]["numbers"]
    for name in [name for name in numbers if name.startswith("s_") and name not in ("s_0", "s_1")]:
        del numbers[name]
    quantities = derivation["quantities"]
    del quantities["largest_slew"]
    reach = float.fromhex(quantities["frequency_error_radius"]["hi"])
    level = float.fromhex(numbers["s_1"])
    bias = -float.fromhex(quantities["bias_frequency"]["lo"])
    def say(enclosure, value):
        value *= 1.0 + 1e-12
        enclosure["lo"] = enclosure["hi"] = value.hex()
        enclosure["decimal"] = f"[{value - 1e-8:.9f}, {value + 1e-8:.9f}]"
    say(quantities["ultimate_frequency_error"], bias + level * reach)
    say(quantities["frequency_error_bound"], bias + level * reach)
    say(quantities["contraction_rate"], level)
    say(derivation["conditions"][1]["lhs"], level)
    for claim in certificate["claims"]:
        claim["evidence"] = {"frequency_error_bound": quantities["frequency_error_bound"]}
    certificate["comparison"] = []


def main():
    certificate = json.load(open(sys.argv[1], encoding="utf-8"))
    kind = sys.argv[2]
    without_sets = {
        "theorem-2.9": lambda id: id in ("theorem-2.9/printed", "theorem-2.9/errata"),
        "published": lambda id: not id.startswith(("theorem-2.9/", "contraction")),
        "repaired": lambda id: id == "theorem-2.9/repaired",
    }
    if kind.startswith("kkl"):
        kkl(certificate, kind)
    elif kind == "steady-state":
        keep(certificate, ["single-channel-bias"], ["proposition-1/if", "proposition-1/only-if"])
        del certificate["derivations"][0]["quantities"]["quadrature_bias"]
    elif kind == "steady-set":
        keep(certificate, ["contraction"], ["ekf/frequency-error-bound"])
        steady_set(certificate)
    elif kind == "frozen-filter":
        keep(certificate, ["single-channel/transfer-function"], [])
    elif kind == "phases":
        keep(certificate, ["contraction"], [c["id"] for c in certificate["claims"] if c["id"].startswith("ekf/")])
        derivation = certificate["derivations"][0]
        derivation["evidence"] = [e for e in derivation["evidence"] if not e["name"].startswith("largest-")]
        for name in ("largest_noise", "largest_slew"):
            del derivation["quantities"][name]
    elif kind in without_sets:
        kept = [d["id"] for d in certificate["derivations"] if without_sets[kind](d["id"])]
        gaps = [claim["id"] for claim in certificate["claims"]
                if kind == "published" and claim["id"].startswith("theorem-2.9/")
                and not claim["id"].endswith("/conditions")]
        keep(certificate, kept, gaps + [id + "/conditions" for id in kept])
        certificate["certified_sets"] = []
        certificate["design"]["require"] = {}
        certificate["verdict"] = "nothing-required"
    else:
        keep(certificate, ["contraction"],
             ["ekf/frequency-error-bound", "ekf/settling-time", "ekf/guarantee"])
        derivation = certificate["derivations"][0]
        drop_unproved(derivation)
        if kind in ("one-set", "capture"):
            one_set(certificate, derivation)
        if kind == "capture":
            capture(certificate)
    json.dump(certificate, sys.stdout, indent=2, ensure_ascii=False)
    sys.stdout.write("\n")


def drop_unproved(derivation):
    derivation["quantities"] = {name: quantity for name, quantity in derivation["quantities"].items()
                                if quantity.get("proved", True)}


def kkl(certificate, kind):
    claims = []
    if kind == "kkl-observer":
        claims = [claim["id"] for claim in certificate["claims"]]
        easier = {"lo": "0x1.dp-6", "hi": "0x1.dp-6", "decimal": "[0.0283203125, 0.0283203125]"}
        owners = [next(d for d in certificate["derivations"] if d["id"] == "kkl-robustness")["quantities"]]
        owners += [claim["evidence"] for claim in certificate["claims"]]
        for owner in owners:
            if "amplitude_error_bound" in owner:
                owner["amplitude_error_bound"].update(easier)
    else:
        certificate["design"]["require"] = {}
        certificate["verdict"] = "nothing-required"
    keep(certificate, ["kkl-ell", "kkl-robustness" if kind == "kkl-observer" else "kkl-paper"], claims)
    for derivation in certificate["derivations"]:
        drop_unproved(derivation)


def one_set(certificate, derivation):
    """The set that bounds the frequency error, and nothing that rests on another."""
    sets = {found["purpose"]: found for found in certificate["certified_sets"]}
    certificate["certified_sets"] = [sets["frequency-error-bound"]]
    quantities = derivation["quantities"]
    derivation["quantities"] = {"frequency_error_bound": quantities["frequency_error_bound"]}
    derivation["conditions"] = derivation["conditions"][:3]
    invariant = derivation["conditions"][2]
    invariant["verdict"] = "undecided"
    del invariant["lhs"], invariant["rhs"]
    derivation["verdict"] = "undecided"
    certificate["claims"] = [claim for claim in certificate["claims"] if claim["id"] != "ekf/settling-time"]
    del certificate["design"]["require"]["settles_within"]
    certificate["comparison"] = []


def capture(certificate):
    """From 0.012 rad/sample off, after six samples."""
    assume = certificate["design"]["assume"]
    assume["initial_frequency_error"] |= enclosure(math.nextafter(0.012, 0), math.nextafter(0.012, 1)) | {"text": "0.012"}
    the_set = certificate["certified_sets"][0]
    the_set["purpose"] = "start-error"
    rate, gain, frequency = (float.fromhex(number) for number in
                             (the_set["rate"], the_set["noise_gain"], the_set["metric"][2][2]))
    ultimate = gain * 0.001 / math.sqrt(1 - rate**2) / frequency
    box = [-0.00501, 0.00501, -0.00501, 0.00501, -0.01201, 0.01201, 6.0, 0.0443]
    quantities = {"capture_samples": enclosure(6), "frequency_error_bound": enclosure(0.012011),
                  "ultimate_frequency_error": enclosure(ultimate * 1.000001), "cells": enclosure(1), "cells_captured": enclosure(1)}
    for quantity in quantities.values():
        quantity |= {"symbol": "", "formula": "", "source": "docs/contraction.md"}
    reason = "every assumed start, in 1 boxes, enters the certified set within 6 samples."
    certificate["derivations"] = [{
        "id": "capture", "title": "Capture of every assumed start by the certified set", "quantities": quantities,
        "conditions": [{"id": "certified-set", "statement": "V \\le V_\\Omega,\\ W \\le W_\\Omega",
                        "verdict": "proved", "reason": "the set is invariant under this noise and slew."},
                       {"id": "starts-captured", "statement": "X(k_c) \\in \\Omega \\text{ from every assumed start}",
                        "verdict": "proved", "reason": reason}],
        "verdict": "proved",
        "evidence": [{"name": "cover", "numbers": {"noise": assume["noise"]["hi"], "slew": "0x0p+0"},
                      "matrices": {"boxes": [[number.hex() for number in box]]}}],
        "notes": []}]
    certificate["claims"] = [{
        "id": "ekf/capture", "verdict": "proved", "required": False, "reason": reason, "evidence": quantities,
        "statement": "From every assumed start, with the assumed noise and slew, the tracker comes into the certified "
                     "set, which it never leaves."}] + certificate["claims"]
    for claim in certificate["claims"][1:]:
        claim["evidence"] = {"frequency_error_bound": quantities["frequency_error_bound"]}
        claim["statement"] = claim["statement"].replace("0.005 rad/sample", "0.012 rad/sample").replace("0.00556", "0.0121")


def enclosure(low, high=None):
    high = low if high is None else high
    return {"lo": float(low).hex(), "hi": float(high).hex(), "decimal": f"[{decimal.Decimal(low)}, {decimal.Decimal(high)}]"}


main()
