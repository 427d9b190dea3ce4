"""The block tracker on arrays: against its formulas, written as matrices, and against the tone."""

import math

import numpy as np
import pytest

import veritrack
from conftest import ROOT

T, M, L = 256, 40, 2
Q = np.diag([5e-5, 1e-3, 2.5e-3])
R = 3e-3


def tone(n, offset, *, amplitude=1.0, phase=0.3, noise=0.0, seed=5):
    """A tone `offset` bins beside bin M: the real part of what (4.9) sees, amplitude cos(phase + ...)."""
    k = np.arange(n)
    samples = amplitude * np.cos(2 * math.pi * (M + offset) / T * k + phase)
    return samples + noise * np.random.default_rng(seed).normal(size=n)


def bins_of(block):
    """Bins M - L ... M + L of (4.4), with the factor 1/T."""
    k = np.arange(T)
    return np.array([(block * np.exp(-2j * math.pi * m * k / T)).sum() / T for m in range(M - L, M + L + 1)])


def measured(x):
    """(4.9), with the limit at d = 0, and its Jacobian by differences of complex steps where it is smooth."""
    x1, x2, x3 = x
    d = M - np.arange(M - L, M + L + 1) + x3
    return x1**2 * np.exp(1j * x2) * (np.exp(2j * math.pi * x3) - 1) / (1j * d)


class TextbookFilter:
    """Chapter 4 as matrices: real and imaginary parts of the bins, H by central differences."""

    def __init__(self, x, p):
        self.x, self.P = np.array(x), np.array(p)

    def step(self, bins):
        def both(values):
            return np.concatenate([values.real, values.imag])

        h = 1e-6
        H = np.stack([(both(measured(self.x + h * e)) - both(measured(self.x - h * e))) / (2 * h) for e in np.eye(3)], 1)
        S = H @ self.P @ H.T + R * np.eye(2 * (2 * L + 1))
        K = self.P @ H.T @ np.linalg.inv(S)
        self.x = self.x + K @ both(bins - measured(self.x))
        self.P = (np.eye(3) - K @ H) @ self.P
        filtered = self.x.copy(), self.P.copy()
        F = np.array([[1, 0, 0], [0, 1, 2 * math.pi], [0, 0, 1]])
        self.x, self.P = F @ self.x, F @ self.P @ F.T + Q
        return filtered


def tracker(**changes):
    options = {"block_length": T, "centre": M, "half_width": L, "frequency": 2 * math.pi * (M + 0.1) / T, "phase": 0.2,
               "covariance": 0.01 * np.eye(3), **changes}
    return veritrack.DftBlockEkf(*np.diag(Q), R, **options)


def test_the_block_tracker_is_the_textbook_filter():
    samples = tone(30 * T, 0.13, noise=0.3)
    track = tracker().run(samples)
    assert track.frequency.shape == (30,) and track.covariance.shape == (30, 3, 3)
    other = TextbookFilter([math.sqrt(1 / (4 * math.pi)), 0.2, 0.1], 0.01 * np.eye(3))
    for k, block in enumerate(samples.reshape(30, T)):
        x, p = other.step(bins_of(block))
        np.testing.assert_allclose([math.sqrt(track.amplitude[k] / (4 * math.pi)), track.phase[k], track.offset[k]], x,
                                   rtol=1e-6, atol=1e-6)
        np.testing.assert_allclose(track.covariance[k], p, rtol=1e-5, atol=1e-8)
        assert track.deviation[k] == pytest.approx(2 * math.pi / T * math.sqrt(p[2, 2]), rel=1e-5)
    assert track.frequency[-1] == pytest.approx(2 * math.pi * (M + 0.13) / T, abs=0.05 * 2 * math.pi / T)
    assert track.lock[:18].tolist() == ["settling"] * 18 and (track.lock[20:] == "lock").all()


def test_a_batch_is_its_trackers_one_by_one_and_a_recording_may_come_in_parts():
    rows = np.stack([tone(10 * T + 7, offset, noise=0.1) for offset in (-0.2, 0.0, 0.3)])
    batch = tracker(frequency=2 * math.pi * (M + np.array([-0.2, 0.0, 0.3])) / T)
    whole = batch.copy().run(rows, threads=2)
    for i, row in enumerate(rows):
        alone = tracker(frequency=2 * math.pi * (M + [-0.2, 0.0, 0.3][i]) / T).run(row)
        assert np.array_equal(alone.frequency, whole.frequency[i]) and np.array_equal(alone.lock, whole.lock[i])
    parts = [batch.run(part) for part in np.split(rows, [100, 1000, 1001], axis=-1)]
    assert [part.frequency.shape for part in parts] == [(3, 0), (3, 3), (3, 0), (3, 7)]
    assert np.array_equal(np.concatenate([part.phase for part in parts], axis=-1), whole.phase)


def test_a_false_lock_and_noise_alone_are_told():
    samples = tone(60 * T, 0.0)
    wrong = tracker(frequency=2 * math.pi * (M + 1.2) / T, covariance=1e-4 * np.eye(3)).run(samples)
    assert wrong.lock[-1] == "false lock" and abs(wrong.offset[-1]) > 0.5 and wrong.unexplained[-1] > 0.5
    assert wrong.best_frequency[-1] == pytest.approx(2 * math.pi * M / T, abs=2 * math.pi / T / 16)
    noise = tracker().run(np.random.default_rng(1).normal(size=60 * T))
    assert noise.lock[-1] == "no tone"


def test_a_start_is_found_in_the_first_block():
    start = veritrack.DftBlockEkf.start_of(tone(T, 0.37, amplitude=2.0, phase=0.6), centre=M, half_width=L)
    assert start["frequency"] == pytest.approx(2 * math.pi * (M + 0.37) / T, abs=0.02 * 2 * math.pi / T)
    assert start["amplitude"] == pytest.approx(2.0, rel=0.02) and start["phase"] == pytest.approx(0.6, abs=0.05)
    with pytest.raises(ValueError, match="one axis of finite"):
        veritrack.DftBlockEkf.start_of([np.nan] * T, centre=M, half_width=L)


def test_designs_and_what_is_none():
    design = veritrack.Design.from_file(ROOT / "designs/block/la-scala-1994-set-1-at-5-db.toml")
    with pytest.raises(ValueError, match="without centre"):
        veritrack.DftBlockEkf.from_design(design, frequency=0.9)
    found = veritrack.DftBlockEkf.from_design(design.replace({"design.centre": 300}), frequency=2 * math.pi * 300 / 2048)
    assert found.run(np.zeros(5000)).frequency.shape == (2,)
    with pytest.raises(ValueError, match="NaN"):
        tracker().run([math.nan])
    for changes in ({"half_width": 0}, {"centre": 1}, {"block_length": 84}, {"memory": 0}, {"amplitude": 0},
                    {"frequency": math.nan}, {"covariance": [[1, 2, 0], [0, 1, 0], [0, 0, 1]]}):
        with pytest.raises(ValueError, match="allowed|finite"):
            tracker(**changes)
