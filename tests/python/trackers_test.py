"""Trackers on arrays: against the textbook formulas, and as an interpreter needs them."""

import ctypes
import math
import signal
import threading

import numpy as np
import pytest

import veritrack
from veritrack.trackers import ZeroInnovationVariance

SEED = 20240


def tone(n, frequency, *, noise=0.0, seed=SEED):
    """exp(j frequency k), k = 1, ..., n, with Gaussian noise of this deviation in each channel."""
    random = np.random.default_rng(seed)
    k = np.arange(1, n + 1)
    return np.exp(1j * frequency * k) + noise * (random.normal(size=n) + 1j * random.normal(size=n))


class FilterPyEkf:
    """FilterPy's ExtendedKalmanFilter.predict and .update (R. Labbe), with its formulas and its order of them:
    x = f(x), P = F P F' + Q; y = z - H x, S = H P H' + R, K = P H' S^-1, x = x + K y,
    P = (I - K H) P (I - K H)' + K R K'."""

    def __init__(self, x, p, q, r, h, epsilon):
        self.x, self.P, self.Q, self.R, self.H, self.epsilon = x, p, q, r, h, epsilon

    def step(self, z):
        x1, x2, w = self.x
        c, s = math.cos(w), math.sin(w)
        y1, y2 = c * x1 - s * x2, s * x1 + c * x2
        F = np.array([[c, -s, -y2], [s, c, y1], [0, 0, 1 - self.epsilon]])
        self.x = np.array([y1, y2, (1 - self.epsilon) * w])
        self.P = F @ self.P @ F.T + self.Q
        innovation = z - self.H @ self.x
        S = self.H @ self.P @ self.H.T + self.R
        K = self.P @ self.H.T @ np.linalg.inv(S)
        nis = innovation @ np.linalg.inv(S) @ innovation
        self.x = self.x + K @ innovation
        I_KH = np.eye(3) - K @ self.H
        self.P = I_KH @ self.P @ I_KH.T + K @ self.R @ K.T
        return innovation, nis


@pytest.mark.parametrize("epsilon", [0.0, 0.01])
def test_the_quadrature_tracker_is_the_textbook_filter(epsilon):
    samples = tone(600, 0.7, noise=0.05)
    start = np.array([0.9, 0.1, 0.6])
    covariance = np.array([[0.2, 0.01, 0.0], [0.01, 0.3, 0.02], [0.0, 0.02, 0.1]])
    tracker = veritrack.QuadratureEkf(0.0023, 0.0012, 0.05, epsilon, frequency=start[2],
                                      phasor=start[0] + 1j * start[1], covariance=covariance)
    track = tracker.run(samples)
    other = FilterPyEkf(start, covariance, np.diag([0.0023, 0.0023, 0.0012]), 0.05 * np.eye(2),
                        np.eye(3)[:2], epsilon)
    for k, sample in enumerate(samples):
        innovation, nis = other.step(np.array([sample.real, sample.imag]))
        # Two orders of the same operations: they differ by rounding, which a stable filter forgets.
        np.testing.assert_allclose([track.phasor[k].real, track.phasor[k].imag, track.frequency[k]], other.x,
                                   rtol=1e-11, atol=1e-11)
        np.testing.assert_allclose(track.innovation[k], innovation[0] + 1j * innovation[1], atol=1e-11)
        assert track.nis[k] == pytest.approx(nis, rel=1e-9)
        assert track.deviation[k] == pytest.approx(math.sqrt(other.P[2, 2]), rel=1e-10)
    np.testing.assert_allclose(tracker.covariance, other.P, rtol=1e-9, atol=1e-13)
    np.testing.assert_allclose(tracker.state, other.x, rtol=1e-11)


def test_the_single_channel_tracker_is_the_textbook_filter():
    samples = tone(600, 1.1, noise=0.05).real
    start, covariance = np.array([1.0, 0.0, 1.0]), 0.05 * np.eye(3)
    noise = np.diag([0.005, 0.005, 0.001])
    tracker = veritrack.SingleChannelEkf(noise, 0.01, 0.002, frequency=1.0, covariance=covariance)
    track = tracker.run(samples)
    other = FilterPyEkf(start, covariance, noise, np.array([[0.01]]), np.eye(3)[:1], 0.002)
    for k, sample in enumerate(samples):
        innovation, nis = other.step(np.array([sample]))
        np.testing.assert_allclose([track.phasor[k].real, track.phasor[k].imag, track.frequency[k]], other.x,
                                   rtol=1e-10, atol=1e-10)
        assert track.innovation[k] == pytest.approx(innovation[0], abs=1e-10)
        assert track.nis[k] == pytest.approx(nis, rel=1e-8, abs=1e-12)
    np.testing.assert_allclose(tracker.covariance, other.P, rtol=1e-8, atol=1e-13)


def test_a_batch_is_its_trackers_one_by_one_to_the_last_bit():
    q2 = np.geomspace(1e-5, 1e-2, 7)
    r = np.array([[0.01], [0.1]])
    samples = tone(300, 0.4, noise=0.1)
    batch = veritrack.QuadratureEkf(0.001, q2, r, frequency=0.3)
    assert batch.shape == (2, 7)
    for threads in (1, 3, 100):
        track = batch.copy().run(samples, threads=threads)
        assert track.frequency.shape == (2, 7, 300)
        for i in range(2):
            for j in range(7):
                alone = veritrack.QuadratureEkf(0.001, q2[j], r[i, 0], frequency=0.3).run(samples)
                assert np.array_equal(track.frequency[i, j], alone.frequency)
                assert np.array_equal(track.phasor[i, j], alone.phasor)


def test_trackers_side_by_side_are_the_trackers_up_to_the_rounding_of_sine_and_cosine():
    q2 = np.geomspace(1e-5, 1e-2, 7)
    r = np.array([[0.01], [0.1], [0.03]])
    rows = np.stack([tone(400, 0.4, noise=0.1, seed=seed) for seed in range(21)]).reshape(3, 7, 400)
    rows[1, 2, 50:60] = np.nan
    alone = veritrack.QuadratureEkf(0.001, q2, r, 0.001, frequency=0.3).run(rows)
    for threads in (1, 2):
        batch = veritrack.QuadratureBatch(0.001, q2, r, 0.001, frequency=0.3)
        assert batch.shape == (3, 7)
        halves = [batch.run(part, threads=threads) for part in (rows[..., :150], rows[..., 150:])]
        for name in ("frequency", "phasor", "deviation", "innovation", "nis"):
            together = np.concatenate([getattr(half, name) for half in halves], axis=-1)
            np.testing.assert_allclose(together, getattr(alone, name), rtol=1e-9, atol=1e-10)
    assert np.isnan(alone.nis).sum() == 10


@pytest.mark.parametrize("kind", ["PackedQuadratureBatch", "SinglePackedQuadratureBatch"])
def test_all_sets_of_instructions_give_the_same_bits(kind):
    from veritrack import _trackers
    random = np.random.default_rng(SEED)
    design = np.column_stack([random.uniform(1e-4, 1e-2, 21), random.uniform(1e-5, 1e-2, 21),
                              random.uniform(0.01, 1, 21), random.uniform(0, 0.01, 21)])
    state = np.column_stack([np.ones(21), np.zeros(21), random.uniform(-100, 100, 21)])
    samples = tone(300, 0.4, noise=0.3).view(float).reshape(1, 300, 2)
    found = []
    for name in _trackers.instruction_sets():
        batch = getattr(_trackers, kind)(design, state, np.tile(np.eye(3).ravel(), (21, 1)))
        found.append(b"".join(each.tobytes() for each in batch.run(samples, 1, name)))
    assert found[0] and all(each == found[0] for each in found)


@pytest.mark.parametrize("threads", [1, 3])
def test_single_precision_is_that_of_double_to_its_digits(threads):
    arguments = dict(q1=0.001, q2=np.geomspace(1e-4, 1e-2, 70), r=0.05, frequency=0.35)
    samples = tone(300, 0.4, noise=0.1)
    samples[100:105] = np.nan
    single = veritrack.QuadratureBatch(**arguments, dtype=np.float32)
    halves = [single.run(part, threads=threads) for part in (samples[:70], samples[70:])]
    double = veritrack.QuadratureBatch(**arguments).run(samples, threads=threads)
    for name, kind in (("frequency", np.float32), ("phasor", np.complex64), ("deviation", np.float32),
                       ("innovation", np.complex64), ("nis", np.float32)):
        found = np.concatenate([getattr(half, name) for half in halves], axis=-1)
        assert found.dtype == kind
        np.testing.assert_allclose(found, getattr(double, name), rtol=1e-3, atol=1e-4)
    difference = np.abs(halves[1].frequency - double.frequency[:, 70:])
    assert 1e-9 < difference.max() < 1e-5
    assert single.state.shape == (70, 3) and np.array_equal(single.state[:, 2], halves[1].frequency[:, -1])
    with pytest.raises(ValueError, match="float16"):
        veritrack.QuadratureBatch(**arguments, dtype=np.float16)


def test_a_row_of_samples_for_each_tracker():
    rows = np.stack([tone(100, 0.4), tone(100, 0.9)])
    track = veritrack.QuadratureEkf(0.001, 0.001, 0.01, frequency=[0.4, 0.9]).run(rows)
    np.testing.assert_allclose(track.frequency[:, -1], [0.4, 0.9], atol=1e-9)
    with pytest.raises(ValueError, match="shape of the batch"):
        veritrack.QuadratureEkf(0.001, 0.001, 0.01, frequency=[0.4, 0.9, 1]).run(rows)


def test_a_recording_in_parts_is_the_recording():
    samples = tone(200, 0.5, noise=0.1)
    whole = veritrack.QuadratureEkf(0.001, 0.001, 0.01, frequency=0.4)
    parts = whole.copy()
    track = whole.run(samples)
    pieces = [parts.run(piece).frequency for piece in np.split(samples, [1, 90])]
    assert np.array_equal(track.frequency, np.concatenate(pieces))
    assert np.array_equal(parts.state, whole.state)


def test_complex_samples_and_pairs_are_the_same():
    samples = tone(50, 0.5, noise=0.1)
    pairs = np.stack([samples.real, samples.imag], axis=-1)
    one = veritrack.QuadratureEkf(0.001, 0.001, 0.01, frequency=0.4).run(samples)
    other = veritrack.QuadratureEkf(0.001, 0.001, 0.01, frequency=0.4).run(pairs)
    assert np.array_equal(one.frequency, other.frequency)


def test_a_missing_sample_is_predicted():
    samples = tone(200, 0.5)
    samples[100:110] = np.nan
    track = veritrack.QuadratureEkf(0.001, 0.001, 0.01, frequency=0.45).run(samples)
    assert np.isnan(track.nis[100:110]).all() and np.isfinite(track.nis[110:]).all()
    assert (np.diff(track.deviation[99:110]) > 0).all()
    np.testing.assert_allclose(track.phasor[109], np.exp(1j * 0.5 * 110), atol=1e-6)


def test_the_kkl_observer_finds_the_tone():
    interval, frequency = 1e-3, 3.0
    t = interval * np.arange(20000)
    track = veritrack.KklObserver([1, 2, 3, 4], 0.0, interval).run(2 * np.sin(frequency * t + 0.4))
    assert track.frequency[-1] == pytest.approx(frequency, abs=1e-4)
    assert track.amplitude[-1] == pytest.approx(2, abs=1e-3)
    with pytest.raises(ValueError, match="NaN"):
        veritrack.KklObserver([1, 2, 3, 4], 5, interval).run([0.0, np.nan])
    with pytest.raises(ValueError, match="four to eight"):
        veritrack.KklObserver([1, 2, 3], 5, interval)


def test_the_notches_find_the_tone():
    samples = tone(20000, 0.6, noise=0.05)
    both = veritrack.QuadratureNotch(0.95, 1e-3, frequency=0.5).run(samples)
    one = veritrack.RealNotch(0.95, 1e-3, frequency=0.5).run(samples.real)
    assert both.frequency[-2000:].mean() == pytest.approx(0.6, abs=5e-3)
    assert one.frequency[-2000:].mean() == pytest.approx(0.6, abs=2e-2)


def test_what_is_no_design_is_refused():
    for arguments in ({"r": 0}, {"q2": 0}, {"q1": -1}, {"epsilon": 1}, {"q1": math.nan}):
        with pytest.raises(ValueError, match="allowed|finite"):
            veritrack.QuadratureEkf(**{"q1": 1, "q2": 1, "r": 1, "frequency": 0, **arguments})
    with pytest.raises(ValueError, match="symmetric"):
        veritrack.QuadratureEkf(1, 1, 1, frequency=0, covariance=[[1, 2, 0], [0, 1, 0], [0, 0, 1]])


def test_a_tracker_that_throws_has_not_moved():
    tracker = veritrack.SingleChannelEkf(np.diag([0, 0, 0.1]), 0.0, frequency=0.5, covariance=np.zeros((3, 3)))
    before = tracker.state
    with pytest.raises(ZeroInnovationVariance):
        tracker.run([1.0, 0.5])
    assert np.array_equal(before, tracker.state)


# ---- the interpreter's arithmetic

LIBM = ctypes.CDLL("libm.so.6")
UPWARD, INVALID = 0x800, 0x01


def test_rounding_mode_and_flags_of_the_interpreter_stay():
    samples = tone(50, 0.5, noise=0.1)
    start = veritrack.QuadratureEkf(0.001, 0.001, 0.01, frequency=0.4)
    expected = start.copy().run(samples, threads=1).frequency
    upward = start.copy()
    try:
        LIBM.fesetround(UPWARD)
        LIBM.feclearexcept(0x3F)
        found = upward.run(samples, threads=1)
        mode, flags = LIBM.fegetround(), LIBM.fetestexcept(INVALID)
    finally:
        LIBM.fesetround(0)
    assert mode == UPWARD and flags == 0
    assert np.array_equal(found.frequency, expected)


def test_a_flag_that_was_clear_is_clear_after_a_nan():
    LIBM.feclearexcept(0x3F)
    veritrack.RealNotch(0.9, 0.1, frequency=0.5).run([1e308, -1e308, 1e308], threads=1)
    assert LIBM.fetestexcept(0x3F) == 0


def test_other_threads_run_meanwhile():
    # A thread that needs the interpreter gets on while a long call is at work, or this never ends.
    tracker = veritrack.QuadratureEkf(0.001, np.full(64, 0.001), 0.01, frequency=0.4)
    samples = tone(20000, 0.5)
    ended, turns = threading.Event(), []

    def call():
        tracker.run(samples, threads=1)
        ended.set()

    thread = threading.Thread(target=call)
    thread.start()
    while not ended.is_set():
        turns.append(1)
    thread.join()
    assert len(turns) > 100


def test_threads_that_call_one_tracker_do_no_harm():
    samples = tone(2000, 0.5, noise=0.1)
    reference = veritrack.QuadratureEkf(0.001, 0.001, 0.01, frequency=0.4)
    states = []
    for _ in range(4):
        reference.run(samples)
        states.append(reference.state)
    tracker = veritrack.QuadratureEkf(0.001, 0.001, 0.01, frequency=0.4)
    threads = [threading.Thread(target=tracker.run, args=(samples,), kwargs={"threads": 1}) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert any(np.array_equal(tracker.state, state) for state in states)


@pytest.mark.parametrize("threads", [1, 2])
def test_an_interrupt_ends_a_long_call_and_no_tracker_has_moved(threads):
    class Interrupted(Exception):
        pass

    def interrupt(number, frame):
        raise Interrupted

    tracker = veritrack.QuadratureEkf(0.001, np.full(threads, 0.001), 0.01, frequency=0.4)
    before = tracker.state
    samples = np.ones(2_000_000, complex)  # a sixth of a second
    old = signal.signal(signal.SIGALRM, interrupt)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with pytest.raises(Interrupted):
            tracker.run(samples, threads=threads)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)
    # Had it been looked for only after the call, all trackers would have moved.
    assert np.array_equal(tracker.state, before)
    assert tracker.run(samples[:10]).frequency.shape == (threads, 10)
