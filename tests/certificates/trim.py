#!/usr/bin/env python3
"""Makes the certificates of accepted/ from whole ones: a certificate that states less is a certificate.

usage: trim.py CERTIFICATE.json NAME > accepted/NAME.json

From designs/la-scala-1994-figure-3.5-without-leak.toml:
theorem-2.9       the two readings of Theorem 2.9 and their claims; no certified set
published         the published results and the places of the proof of Theorem 2.9; no certified set
repaired          the repaired theorem
contraction       all certified sets, the derivation "contraction" and the claims that rest on it
settling          the same from the sets that bound the frequency error, in the long run too: checked fast
one-set           the same from the set that is checked fastest, for tests that check it hundreds of times
given-covariance  one-set with a P(0|0) that the design gives
covariance-range  one-set with every P(0|0) from one matrix of the design to another
covariance-multiples  one-set with every P(0|0) from one multiple of the printed matrix to another
capture           farther starts, followed into the set of one-set: one box, of which little is said
From designs/motor-tone-8-khz.toml:
hertz             as settling, of a design in Hz
From tests/certificates/kkl-observer.toml, a KKL observer at one frequency with a sinusoidal disturbance:
kkl-observer      its bounds, with an easier one on the amplitude error
kkl-paper         its ell and the paper's claims
From tests/certificates/kkl-sampled.toml, the same observer as a program that gets samples:
kkl-sampled       its bounds
From tests/certificates/kkl-rounding.toml, rates for which rounding counts:
kkl-rounding      its bounds
From tests/certificates/kkl-close-rates.toml and kkl-wide-rates.toml, as they are:
kkl-close-rates   rates 1, 1.001, 1.002, 1.003: ell is 8e-27
kkl-wide-rates    rates 0.01, 1, 100, 1e4
From tests/certificates/kkl-five-filters.toml and kkl-six-filters.toml, observers with more filters than the paper's:
kkl-five-filters  its ell and the paper's claims, with an ell in use that the design gives
kkl-six-filters   the same with the proved ell
From tests/certificates/kkl-five-filters-disturbed.toml and kkl-six-filters-sampled.toml:
kkl-five-filters-disturbed  its bounds under a sinusoidal disturbance
kkl-six-filters-sampled     its bounds under a bounded one, as a program that gets samples
From tests/certificates/steady-state.toml, the single-channel tracker with a leak at one frequency:
steady-state      its bias and Proposition 1
frozen-filter     its frozen filter, alone
From tests/certificates/phases.toml, the single-channel tracker at one frequency:
phases            its sets over all phases, and the claims that rest on them
From tests/certificates/lock.toml:
lock              the probability of losing lock in Gaussian noise
mean-square       the same with the mean square in lock, and a larger bound on it: checked faster
lowest-snr        the same set as one for the lowest signal-to-noise ratio: checked fast
From tests/certificates/lock-with-leak.toml:
mean-square-with-leak  as mean-square, in a narrow band
From tests/certificates/steady-set.toml, the quadrature tracker with a leak in a narrow band:
steady-set        the contraction with two levels, and the set for the largest noise
From tests/certificates/steady-pieces.toml, the same in a band that is cut:
steady-pieces     as steady-set, with sets for pieces of the band
From tests/certificates/model-observer.toml, a recursion of the design file at almost one frequency:
model-observer    as it is: tubes with levels, with noise and without
model-part        the same sets, which are a part of a wider band
From tests/certificates/model-from-rest.toml, a recursion whose start is known:
model-from-rest   its tube for the assumed noise, and the claims that rest on it
From tests/certificates/model-moving.toml, a loop with an angle, and a frequency that moves:
model-moving      its tube for what is assumed, in two cells
From tests/certificates/model-constant-amplitude.toml, such a loop, and a constant amplitude in a range:
model-constant-amplitude  its tubes for what is assumed, for two parts of the range
From tests/certificates/model-gains.toml and model-gains-unstable.toml, loops of two channels, as they are:
model-gains       all claims that gains decide
model-gains-unstable  a loop that is REFUTED
From tests/certificates/model-gains-one-channel.toml, as it is:
model-gains-one-channel  a loop whose detector also sees twice the frequency
From tests/certificates/model-phases.toml, a loop of one channel with a ripple:
model-phases      its gains over the phases and on the average, and the tubes on which its bias rests
From tests/certificates/model-gains-linear.toml, as it is:
model-gains-linear  what [require] asks of a linear loop
From tests/certificates/model-gains-arms.toml, model-gains-observer.toml and model-gains-control.toml, as they are:
model-gains-arms    a loop with the arc tangent of two filtered values
model-gains-observer  a vector of states whose length matters, on a band through 0
model-gains-control   samples times a state, with amplitudes in a range
From tests/certificates/model-code.toml and model-code.c, as it is:
model-code        a loop that is a function in C, with its listing
From tests/certificates/model-arithmetic.toml, as it is:
model-arithmetic  a loop of formulas in single precision
From tests/certificates/model-gains-products.toml, as it is:
model-gains-products  a loop in which noise that two samples have in common cancels
From tests/certificates/model-gains-limits.toml, model-gains-signs.toml and model-kinks.toml, as they are:
model-gains-limits  a loop with a clamp that acts and one that does not
model-gains-signs   a loop whose detector has signs, conditions and absolute values
model-kinks         tubes of a tracker with a clamp and a floor of its divisor
From tests/certificates/model-gaussian.toml, a loop with an angle in Gaussian noise:
model-gaussian    its tubes for the assumed noise and for as much as was proved
From tests/certificates/model-filter.toml, an extended Kalman filter at almost one frequency:
model-filter      its tube for the assumed noise, with bounds of the covariance and three levels: checked fast
From tests/certificates/model-filter-gaussian.toml, the same filter in Gaussian noise:
model-filter-gaussian  its tubes for the assumed noise and the lowest ratio, with bounds of the covariance
From tests/certificates/regulator.toml, a regulator with a tracker of two channels:
regulator         as it is, its tracker's certificate without what the regulator does not need
From tests/certificates/model-filter-long-run.toml, the same filter:
model-filter-long-run  its tubes for the assumed noise, and in the long run
From tests/certificates/model-filter-parts.toml, the same filter and a constant amplitude in a range:
model-filter-parts  its tubes for the assumed noise and in the long run, twice: two parts of the range that overlap
From tests/certificates/model-phase-difference.toml, a linear filter and the difference of two phases:
model-phase-difference  its tubes for the assumed noise and for the largest one
From tests/certificates/model-filter-moving.toml, the same filter and a frequency that moves through two cells:
model-filter-moving  its tubes for what is assumed
From tests/certificates/recursion.toml, the single-channel tracker at almost one frequency:
recursion         its certificate as a recursion, with the tube for the assumed noise, and the claims that rest on it
From tests/certificates/dft-block.toml and dft-block-covariance.toml:
dft-block            a block tracker near one offset, with noise and slew
dft-block-covariance  the same with more bins, a range of amplitudes and a given P(1|0)
dft-block-false-locks  of the first: its false locks, alone
From tests/certificates/dft-block-gaussian.toml:
dft-block-gaussian   the probability of losing lock in Gaussian noise, from a smaller set: checked fast
dft-block-lowest-snr  the lowest signal-to-noise ratio, alone
"""
import fractions
import json
import math
import sys


def keep(certificate, derivations, claims):
    certificate["derivations"] = [d for d in certificate["derivations"] if d["id"] in derivations]
    certificate["claims"] = [claim for claim in certificate["claims"] if claim["id"] in claims]


def drop_requirements(certificate, *names):
    """Those of these names, or all."""
    require = certificate["design"]["require"]
    for name in names or list(require):
        del require[name]
    if not require:
        certificate["verdict"] = "nothing-required"


def up(value):
    return math.nextafter(value, math.inf)


def at_most(value):
    return {"hi": float(value).hex()}


def exactly(value):
    return {"lo": float(value).hex(), "hi": float(value).hex()}


def number(text):
    """A number of the design: its text, and the tightest doubles around it."""
    value = float(text)
    exact = fractions.Fraction(text)
    low = math.nextafter(value, -math.inf) if fractions.Fraction(value) > exact else value
    high = up(value) if fractions.Fraction(value) < exact else value
    return {"text": text, "lo": low.hex(), "hi": high.hex()}


def without_sets(is_kept):
    def trim(certificate):
        keep(certificate, [d["id"] for d in certificate["derivations"] if is_kept(d["id"])],
             [c["id"] for c in certificate["claims"] if is_kept(c["id"].removesuffix("/conditions"))])
        certificate["certified_sets"] = []
        drop_requirements(certificate)
    return trim


def is_published(name):
    return not name.startswith(("ekf/", "contraction")) and name not in (
        "theorem-2.9/printed", "theorem-2.9/errata", "theorem-2.9/repaired")


def contraction(certificate):
    keep(certificate, ["contraction"], [c["id"] for c in certificate["claims"] if c["id"].startswith("ekf/")])


def settling(certificate):
    """The sets that say how large the frequency error is, and when."""
    keep(certificate, ["contraction"], ["ekf/frequency-error-bound", "ekf/settling-time", "ekf/guarantee"])
    certificate["certified_sets"] = [found for found in certificate["certified_sets"] if found["purpose"] in
                                     ("frequency-error-bound", "ultimate-error", "settling")]
    derivation = certificate["derivations"][0]
    derivation["quantities"] = certificate["claims"][2]["evidence"]
    derivation["conditions"] = derivation["conditions"][:2]
    del derivation["verdict"]


def hertz(certificate):
    settling(certificate)
    drop_requirements(certificate, "largest_slew_at_least", "frequency_error_radius_at_least")


def one_set(certificate):
    """The set that bounds the frequency error, and nothing that rests on another."""
    keep(certificate, ["contraction"], ["ekf/frequency-error-bound", "ekf/guarantee"])
    certificate["certified_sets"] = [found for found in certificate["certified_sets"]
                                     if found["purpose"] == "frequency-error-bound"]
    derivation = certificate["derivations"][0]
    bound = {"frequency_error_bound": derivation["quantities"]["frequency_error_bound"]}
    derivation["quantities"] = bound
    derivation["conditions"] = derivation["conditions"][:2]
    del derivation["verdict"]
    for claim in certificate["claims"]:
        claim["evidence"] = bound
    drop_requirements(certificate, "settles_within", "settled_below")


def given_covariance(certificate):
    one_set(certificate)
    rows = [["0.00965", "0", "0"], ["0", "0.025", "0.00759"], ["0", "0.00759", "0.00761"]]
    certificate["design"]["assume"]["initial_covariance"] = [[number(text) for text in row] for row in rows]
    del certificate["derivations"][0]["evidence"]


def covariance_range(certificate):
    one_set(certificate)
    ends = {"from": [["0.00955", "0", "0"], ["0", "0.0248", "0.0075"], ["0", "0.0075", "0.00754"]],
            "to": [["0.0097", "0", "0"], ["0", "0.02505", "0.0076"], ["0", "0.0076", "0.00763"]]}
    certificate["design"]["assume"]["initial_covariance"] = {
        name: [[number(text) for text in row] for row in rows] for name, rows in ends.items()}
    del certificate["derivations"][0]["evidence"]


def covariance_multiples(certificate):
    one_set(certificate)
    ends = {"from": "0.99", "to": "1.005"}
    certificate["design"]["assume"]["initial_covariance"] = {name: number(text) for name, text in ends.items()}
    certificate["derivations"][0]["evidence"][0]["decimals"].update(ends)


def capture(certificate):
    """From 0.012 rad/sample off, after six samples."""
    one_set(certificate)
    assume = certificate["design"]["assume"]
    assume["initial_frequency_error"] = number("0.012")
    the_set = certificate["certified_sets"][0]
    the_set["purpose"] = "start-error"
    rate, gain, frequency = (float.fromhex(value) for value in
                             (the_set["rate"], the_set["noise_gain"], the_set["metric"][2][2]))
    ultimate = gain * 0.001 / math.sqrt(1 - rate**2) / frequency
    box = [-0.00501, 0.00501, -0.00501, 0.00501, -0.01201, 0.01201, 6.0, 0.05]
    bound = {"frequency_error_bound": at_most(0.012011)}
    quantities = {"capture_samples": at_most(6), **bound, "ultimate_frequency_error": at_most(ultimate * 1.000001),
                  "cells": exactly(1), "cells_captured": exactly(1)}
    start = certificate["derivations"][0]["evidence"][0]
    start["decimals"].update({"from": "0.999", "to": "1.001"})
    followed = {"name": "cover", "numbers": {"noise": the_set["noise"], "slew": "0x0p+0"},
                "matrices": {"boxes": [[side.hex() for side in box]]}}
    certificate["derivations"] = [{
        "id": "capture", "quantities": quantities,
        "conditions": [{"id": "certified-set", "verdict": "proved"}, {"id": "starts-captured", "verdict": "proved"}],
        "verdict": "proved", "evidence": [start, followed]}]
    for claim in certificate["claims"]:
        claim["evidence"] = bound
    certificate["claims"].insert(0, {"id": "ekf/capture", "verdict": "proved", "required": False,
                                     "evidence": quantities})


def kkl_observer(certificate):
    keep(certificate, ["kkl-ell", "kkl-robustness"],
         [c["id"] for c in certificate["claims"] if c["id"].startswith("kkl/")])
    robustness = next(d for d in certificate["derivations"] if d["id"] == "kkl-robustness")
    for owner in [robustness["quantities"]] + [claim["evidence"] for claim in certificate["claims"]]:
        if "amplitude_error_bound" in owner:
            owner["amplitude_error_bound"] = {"hi": "0x1.dp-6"}


def kkl_bounds(certificate):
    keep(certificate, ["kkl-ell", "kkl-robustness"],
         [c["id"] for c in certificate["claims"] if c["id"].startswith("kkl/")])


def kkl_paper(certificate):
    keep(certificate, ["kkl-ell", "kkl-paper"], [])
    drop_requirements(certificate)


def steady_state(certificate):
    keep(certificate, ["single-channel-bias"], ["proposition-1/if", "proposition-1/only-if"])
    del certificate["derivations"][0]["quantities"]["quadrature_bias"]


def phases(certificate):
    contraction(certificate)
    certificate["claims"] = [claim for claim in certificate["claims"] if claim["id"] != "ekf/limits"]
    derivation = certificate["derivations"][0]
    derivation["evidence"] = [e for e in derivation["evidence"] if not e["name"].startswith("largest-")]
    for name in ("largest_noise", "largest_slew"):
        del derivation["quantities"][name]


def steady_set(certificate):
    """Fewer levels: what rests on the last ones is larger."""
    keep(certificate, ["contraction"], ["ekf/frequency-error-bound", "ekf/guarantee", "ekf/invariant-set"])
    derivation = certificate["derivations"][0]
    derivation["evidence"] = [e for e in derivation["evidence"] if e["name"] != "largest-slew"]
    start = next(e for e in derivation["evidence"] if e["name"] == "start-error")
    numbers = start["numbers"]
    for name in [name for name in numbers if name.startswith("s_") and name not in ("s_0", "s_1")]:
        del numbers[name]
    quantities = derivation["quantities"]
    del quantities["largest_slew"]
    level = float.fromhex(numbers["s_1"])
    bias = -float.fromhex(quantities["bias_frequency"]["lo"])
    # Of that set; other sets may have a larger radius.
    radius = 1.0 / float.fromhex(start["matrices"]["metric"][2][2])
    ultimate = (bias + level * radius) * (1.0 + 1e-12)
    quantities["contraction_rate"] = at_most(level)
    derivation["conditions"][1]["lhs"] = at_most(level)
    quantities["settling_samples"] = at_most(0)
    for name in ("ultimate_frequency_error", "settled_frequency_error", "frequency_error_bound"):
        quantities[name] = at_most(ultimate)
    for claim in certificate["claims"]:
        claim["evidence"] = {name: quantities[name] for name in claim["evidence"]}


def lock(certificate):
    keep(certificate, ["lock"], ["ekf/probability-of-losing-lock", "ekf/guarantee"])
    certificate.pop("lowest_snr_set", None)
    without_mean_square(certificate)


def mean_square(larger):
    """A larger bound is one as well, and checked faster."""
    return lambda certificate: with_larger_mean_square(certificate, larger)


def with_larger_mean_square(certificate, larger):
    keep(certificate, ["lock", "mean-square"],
         ["ekf/probability-of-losing-lock", "ekf/rms-frequency-error", "ekf/guarantee"])
    certificate.pop("lowest_snr_set", None)
    form = certificate["lock_sets"][0]["mean_square"]
    rms = float.fromhex(certificate["derivations"][1]["quantities"]["rms_frequency_error"]["hi"])
    form["bound"] = float.hex(float.fromhex(form["bound"]) + larger ** 2 - rms ** 2)
    certificate["derivations"][1]["quantities"]["rms_frequency_error"] = at_most(larger * (1.0 + 1e-12))
    without_start = math.sqrt(float.fromhex(form["bound"])) * (1.0 + 1e-12)
    certificate["derivations"][1]["quantities"]["rms_frequency_error_without_start"] = at_most(without_start)
    for claim in certificate["claims"]:
        if "rms_frequency_error" in claim["evidence"]:
            claim["evidence"]["rms_frequency_error"] = at_most(larger * (1.0 + 1e-12))


def without_mean_square(certificate):
    certificate["lock_sets"][0].pop("mean_square", None)
    certificate["design"]["require"].pop("rms_frequency_error_below", None)
    for claim in certificate["claims"]:
        claim["evidence"].pop("rms_frequency_error", None)


def lowest_snr(certificate):
    lock(certificate)
    keep(certificate, ["lock"], ["ekf/guarantee"])
    drop_requirements(certificate)
    derivation, claim = certificate["derivations"][0], certificate["claims"][0]
    derivation["id"], claim["id"] = "lowest-snr", "ekf/lowest-snr"
    for values in (derivation["quantities"], claim["evidence"]):
        values["lowest_snr"] = at_most(26.000001)
    certificate["lowest_snr_set"] = certificate.pop("lock_sets")[0]


def model_part(certificate):
    """What is required is required of the wider band, and not decided."""
    certificate["design"]["assume"]["frequency"] = [number("0.05"), number("0.1005")]
    certificate["claims"] = [claim for claim in certificate["claims"] if not claim["required"]]
    for claim in certificate["claims"]:
        claim.update({"from": "0.0995", "to": "0.1005"})
    certificate["verdict"] = "undecided"


def model_from_rest(certificate):
    """Without what is told of another noise than the assumed one."""
    certificate["tubes"] = [tube for tube in certificate["tubes"] if tube["name"] == "assumed"]
    certificate["claims"] = [claim for claim in certificate["claims"]
                             if claim["id"] in ("model/guarantee", "model/capture", "model/capture-time")]


def model_moving(certificate):
    """Without what is told of a frequency that does not move."""
    certificate["tubes"] = [tube for tube in certificate["tubes"] if tube["name"] == "assumed"]
    certificate["claims"] = [claim for claim in certificate["claims"]
                             if claim["id"] not in ("model/limits", "model/slew-limit", "model/steady-state")]


def model_phases(certificate):
    certificate["tubes"] = [tubes for tubes in certificate["tubes"] if tubes["name"] == "starts"]


def model_gaussian(certificate):
    """Without what is told of no noise, and of noise with a bound."""
    certificate["tubes"] = [tube for tube in certificate["tubes"] if tube["name"] in ("gaussian", "lowest-snr")]
    certificate["claims"] = [claim for claim in certificate["claims"]
                             if claim["id"] not in ("model/limits", "model/slew-limit", "model/steady-state")]


def model_filter_parts(certificate):
    keep(certificate, [], ["model/guarantee", "model/frequency-error-bound"])
    certificate["tubes"] = [
        dict(tubes, amplitude=[up(float.fromhex(low)).hex() if is_second else low, high])
        for tubes in certificate["tubes"] if tubes["name"] in ("assumed", "long-run")
        for low, high in [tubes["amplitude"]] for is_second in (False, True)]


def model_phase_difference(certificate):
    keep(certificate, [], [c["id"] for c in certificate["claims"] if c["id"] != "model/steady-state"])
    certificate["tubes"] = [tubes for tubes in certificate["tubes"] if tubes["name"] != "starts"]
    claims = {claim["id"]: claim for claim in certificate["claims"]}
    claims["model/limits"].update(
        reach="0.1", reach_frequency_error=claims["model/guarantee"]["frequency_error"])


def model_filter_moving(certificate):
    """The same, with two levels."""
    model_moving(certificate)
    for tubes in certificate["tubes"]:
        tubes["crossing"] = tubes["crossing"][:1]
        for cell in tubes["cells"]:
            cell["levels"] = cell["levels"][:2]
            cell["shrinking"] = cell["shrinking"][:1]
    for claim in certificate["claims"]:
        claim.pop("settled_frequency_error", None)


def model_long_run(certificate):
    """Without what is told of no noise, and of more."""
    certificate["tubes"] = [tube for tube in certificate["tubes"] if tube["name"] in ("assumed", "long-run")]
    certificate["claims"] = [claim for claim in certificate["claims"]
                             if claim["id"] not in ("model/limits", "model/slew-limit", "model/steady-state")]


def model_filter(certificate):
    """Without what is told of no noise; the error in the long run is that of a level between."""
    certificate["tubes"] = [tube for tube in certificate["tubes"] if tube["name"] == "assumed"]
    certificate["claims"] = [claim for claim in certificate["claims"]
                             if claim["id"] not in ("model/limits", "model/slew-limit", "model/steady-state")]
    for cell in certificate["tubes"][0]["cells"]:
        cell["levels"] = cell["levels"][:3]
        cell["shrinking"] = cell["shrinking"][:2]
    for claim in certificate["claims"]:
        if "settled_frequency_error" in claim:
            claim["settled_frequency_error"] = "0.05"


def without_false_locks(certificate):
    keep(certificate, ["lock-set", "lock-in-noise"],
         [claim["id"] for claim in certificate["claims"]
          if not claim["id"].startswith(("dft-block/every-start", "dft-block/false-lock", "dft-block/lowest-snr"))])


def dft_block_gaussian(certificate):
    without_false_locks(certificate)
    certificate["derivations"][0]["evidence"][0]["numbers"]["radius"] = "0x1.0000000000000p-2"
    for part in [certificate["derivations"][0]["quantities"], *(claim["evidence"] for claim in certificate["claims"])]:
        part["probability_of_losing_lock"]["hi"] = "0x1.0000000000000p-10"


def dft_block_lowest_snr(certificate):
    drop_requirements(certificate)
    keep(certificate, ["lowest-snr"], ["dft-block/lowest-snr"])


def false_locks(certificate):
    drop_requirements(certificate)
    keep(certificate, ["false-lock-below", "false-lock-above"],
         ["dft-block/every-start-locks", "dft-block/false-lock-below", "dft-block/false-lock-above"])


def recursion(certificate):
    """The tube for the assumed noise, with three levels."""
    keep(certificate, [], ["recursion/guarantee", "ekf/largest-noise"])
    inner = certificate["recursion"]
    model_filter(inner)


def regulator(certificate):
    """The tracker's guarantee, its settling time, and the sets that they rest on."""
    tracker = certificate["frequency_tracker"]
    keep(tracker, ["contraction"], ["ekf/settling-time", "ekf/guarantee"])
    tracker["certified_sets"] = [found for found in tracker["certified_sets"] if found["purpose"] in
                                 ("frequency-error-bound", "ultimate-error", "settling")]
    derivation = tracker["derivations"][0]
    derivation["quantities"] = tracker["claims"][1]["evidence"]
    derivation["conditions"] = derivation["conditions"][:2]
    del derivation["verdict"]


KINDS = {
    "theorem-2.9": without_sets(lambda name: name in ("theorem-2.9/printed", "theorem-2.9/errata")),
    "published": without_sets(is_published),
    "repaired": without_sets(lambda name: name == "theorem-2.9/repaired"),
    "contraction": contraction,
    "settling": settling,
    "hertz": hertz,
    "one-set": one_set,
    "given-covariance": given_covariance,
    "covariance-range": covariance_range,
    "covariance-multiples": covariance_multiples,
    "capture": capture,
    "kkl-observer": kkl_observer,
    "kkl-sampled": kkl_bounds,
    "kkl-rounding": kkl_bounds,
    "kkl-paper": kkl_paper,
    "kkl-close-rates": lambda certificate: None,
    "kkl-wide-rates": lambda certificate: None,
    "kkl-five-filters": lambda certificate: keep(certificate, ["kkl-ell", "kkl-paper"], []),
    "kkl-six-filters": lambda certificate: keep(certificate, ["kkl-ell", "kkl-paper"], []),
    "kkl-five-filters-disturbed": kkl_bounds,
    "kkl-six-filters-sampled": kkl_bounds,
    "lock": lock,
    "mean-square": mean_square(0.045),
    "mean-square-with-leak": mean_square(0.05),
    "lowest-snr": lowest_snr,
    "steady-state": steady_state,
    "frozen-filter": lambda certificate: keep(certificate, ["single-channel/transfer-function"], []),
    "phases": phases,
    "steady-set": steady_set,
    "steady-pieces": steady_set,
    "model-observer": lambda certificate: None,
    "model-part": model_part,
    "model-from-rest": model_from_rest,
    "model-moving": model_moving,
    "model-constant-amplitude": model_moving,
    "model-gains": lambda certificate: None,
    "model-gains-unstable": lambda certificate: None,
    "model-gains-one-channel": lambda certificate: None,
    "model-phases": model_phases,
    "model-gains-arms": lambda certificate: None,
    "model-gains-observer": lambda certificate: None,
    "model-gains-control": lambda certificate: None,
    "model-gains-limits": lambda certificate: None,
    "model-gains-linear": lambda certificate: None,
    "model-gains-signs": lambda certificate: None,
    "model-code": lambda certificate: None,
    "model-arithmetic": lambda certificate: None,
    "model-kinks": lambda certificate: None,
    "model-gaussian": model_gaussian,
    "model-filter": model_filter,
    "model-filter-gaussian": model_gaussian,
    "recursion": recursion,
    "regulator": regulator,
    "model-filter-long-run": model_long_run,
    "model-filter-moving": model_filter_moving,
    "model-filter-parts": model_filter_parts,
    "model-phase-difference": model_phase_difference,
    "dft-block": without_false_locks,
    "dft-block-covariance": without_false_locks,
    "dft-block-gaussian": dft_block_gaussian,
    "dft-block-false-locks": false_locks,
    "dft-block-lowest-snr": dft_block_lowest_snr,
}

with open(sys.argv[1], encoding="utf-8") as file:
    trimmed = json.load(file)
KINDS[sys.argv[2]](trimmed)
json.dump(trimmed, sys.stdout, indent=2, ensure_ascii=False)
sys.stdout.write("\n")
