"""Zarchan's filters and the median filter on arrays: against their formulas, written as matrices."""

import itertools

import numpy as np
import pytest

import veritrack

TS, W = 0.1, 1.0
COVARIANCE = np.diag([0.1, 0.5, 0.3])


def wave(n, *, noise=0.0, seed=3):
    t = TS * np.arange(1, n + 1)
    return np.sin(W * t) + noise * np.random.default_rng(seed).normal(size=n)


class Textbook:
    """x^ = f(x), M = F P F' + Q, K = M h / (h' M h + r), x = x^ + K (y - h(x^)), P = (I - K h') M, with h' and F as
    matrices of the slides."""

    def __init__(self, kind, state, covariance, r, noise):
        self.kind, self.x, self.P, self.r, self.noise = kind, np.array(state, float), np.array(covariance), r, noise

    def step(self, y):
        n = len(self.x)
        F, Q, x = np.eye(n), np.zeros((n, n)), self.x.copy()
        phase = np.array([[TS**3 / 3, TS**2 / 2], [TS**2 / 2, TS]]) * self.noise
        if self.kind in ("phase", "known-amplitude"):
            F[0, 1] = TS
            Q[:2, :2] = phase
            x = F @ x
            a = x[2] if n == 3 else 2.0
            h = np.array([a * np.cos(x[0]), 0, np.sin(x[0])])[:n]
            predicted = a * np.sin(x[0])
        else:
            z, slope = (x[2]**2, 2 * x[2]) if self.kind == "oscillator" else (x[2], 1.0)
            c = -slope * x[0]
            F = np.array([[1, TS, 0], [-z * TS, 1, c * TS], [0, 0, 1]])
            Q[1, 1], Q[1, 2], Q[2, 1], Q[2, 2] = c**2 * phase[0, 0], c * phase[0, 1], c * phase[0, 1], phase[1, 1]
            for _ in range(100):
                x[1] -= TS / 100 * z * x[0]
                x[0] += TS / 100 * x[1]
            h, predicted = np.array([1.0, 0, 0]), x[0]
        M = F @ self.P @ F.T + Q
        K = M @ h / (h @ M @ h + self.r)
        self.x, self.P = x + K * (y - predicted), M - np.outer(K, h @ M)
        return self.x, self.P


@pytest.mark.parametrize("kind, state, frequency", [
    ("phase", [0.1, 1.2, 0.9], 1), ("known-amplitude", [0.1, 1.2], 1), ("oscillator", [0.1, 0.9, 1.3], 2),
    ("squared-frequency", [0.1, 0.9, 1.3], 2)])
def test_each_of_the_four_filters_is_the_textbook_filter(kind, state, frequency):
    n = len(state)
    samples = wave(300, noise=0.1) * (2 if kind == "known-amplitude" else 1)
    track = veritrack.SineEkf(kind, TS, 0.01, 1e-3, state=state, covariance=COVARIANCE[:n, :n],
                              amplitude=2.0).run(samples)
    other = Textbook(kind, state, COVARIANCE[:n, :n], 0.01, 1e-3)
    for k, sample in enumerate(samples):
        x, p = other.step(sample)
        np.testing.assert_allclose(track.state[k], x, rtol=1e-8, atol=1e-9)
        assert track.deviation[k] == pytest.approx(np.sqrt(p[frequency, frequency]), rel=1e-7)
    assert track.frequency[-1] == pytest.approx(W, abs=0.15)
    expected = track.state[:, frequency]
    assert np.array_equal(track.frequency, np.sqrt(expected) if kind == "squared-frequency" else expected)


def test_batches_of_filters_and_what_is_none():
    rows = np.stack([wave(50, seed=1, noise=0.1), wave(50, seed=2, noise=0.1)])
    options = {"state": [[0, 1.1, 1], [0, 0.9, 1]], "covariance": COVARIANCE}
    batch = veritrack.SineEkf("phase", TS, 0.01, 1e-3, **options)
    assert batch.shape == (2,)
    together = batch.run(rows, threads=2)
    alone = veritrack.SineEkf("phase", TS, 0.01, 1e-3, state=[0, 0.9, 1], covariance=COVARIANCE).run(rows[1])
    assert np.array_equal(together.state[1], alone.state)
    for changes in ({"kind": "x"}, {"interval": 0}, {"measurement_variance": 0}, {"frequency_noise": -1},
                    {"state": [0, 1]}, {"covariance": np.triu(np.ones((3, 3)))}, {"state": [0, np.nan, 1]}):
        given = {"kind": "phase", "interval": TS, "measurement_variance": 0.01, "frequency_noise": 1e-3, **options, **changes}
        with pytest.raises(ValueError, match="allowed|finite"):
            veritrack.SineEkf(given.pop("kind"), given.pop("interval"), given.pop("measurement_variance"),
                              given.pop("frequency_noise"), **given)
    with pytest.raises(ValueError, match="NaN"):
        batch.run([np.nan])


def test_the_median_filter_is_medians_of_its_subsets():
    samples = np.random.default_rng(4).normal(size=200)
    subsets, weights = [[1], [1, 3, 5], [2, 3, 4, 5, 1], [4]], [0.1, 0.2, 0.3, 0.4]
    found = veritrack.MedianFilter(5, subsets, weights).run(samples)
    filled = np.concatenate([np.full(4, samples[0]), samples])
    for k, value in enumerate(found):
        window = filled[k:k + 5]
        assert value == pytest.approx(sum(w * np.median(window[np.array(s) - 1]) for s, w in zip(subsets, weights)))
    impulses = wave(100)
    impulses[[20, 50]] = 100
    assert np.abs(veritrack.MedianFilter(3).run(impulses)).max() < 1.1
    many = veritrack.MedianFilter(3, shape=(2, 2)).run(np.stack([samples] * 4).reshape(2, 2, 200))
    for i, j in itertools.product(range(2), repeat=2):
        assert np.array_equal(many[i, j], veritrack.MedianFilter(3).run(samples))
    for window, chosen in ((0, None), (33, None), (4, None), (3, [[1, 2]]), (3, [[4]]), (3, [])):
        with pytest.raises(ValueError):
            veritrack.MedianFilter(window, chosen)
    with pytest.raises(ValueError, match="NaN"):
        veritrack.MedianFilter(3).run([np.nan])
