"""The four filters of Zarchan's "Tracking a Sine Wave", and a median filter to go before a tracker."""

from __future__ import annotations

import dataclasses
from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import _trackers
from .trackers import Array, _columns, _one_channel, _require, _Trackers

_KINDS: dict[str, tuple[Any, int]] = {
    "phase": (_trackers.SinePhaseBatch, 3), "known-amplitude": (_trackers.SineKnownAmplitudeBatch, 2),
    "oscillator": (_trackers.OscillatorBatch, 3), "squared-frequency": (_trackers.SquaredFrequencyBatch, 3),
}


@dataclasses.dataclass(frozen=True)
class SineTrack:
    """The results of a filter of a sine wave, for each sample: arrays (..., n), with the batch in front.

    Attributes
    ----------
    state : ndarray, (..., n, states)
        The filtered state; its meaning depends on the kind.
    frequency : ndarray
        rad/s; with "squared-frequency" the root of its state, NaN where that is negative.
    deviation : ndarray
        The deviation of the last but one ("phase") or last state that the filter expects: rad/s, or (rad/s)^2 with
        "squared-frequency".
    """

    state: Array
    frequency: Array
    deviation: Array


class SineEkf(_Trackers):
    """One of the four extended Kalman filters that P. Zarchan's slides compare, of one channel.

    Parameters
    ----------
    kind : {"phase", "known-amplitude", "oscillator", "squared-frequency"}
        The kind, by its state: (phase in rad, frequency in rad/s, amplitude); (phase, frequency); (signal, its
        derivative per s, frequency); (signal, its derivative per s, squared frequency).
    interval : array_like
        The time between samples, s; above 0.
    measurement_variance : array_like
        Signal units squared; above 0.
    frequency_noise : array_like
        Spectral density of the noise of the frequency, or of its square; 0 or more.
    state : array_like, (..., states)
        The start state, one sample before the recording.
    covariance : array_like, (..., states, states)
        The start covariance.
    amplitude_noise : array_like
        Spectral density of the noise of the amplitude, for "phase"; 0 or more.
    amplitude : array_like
        The known amplitude, for "known-amplitude", signal units.
    euler_steps : int
        Euler steps in the prediction of a sample, for the last two kinds.
    """

    def __init__(self, kind: str, interval: ArrayLike, measurement_variance: ArrayLike, frequency_noise: ArrayLike, *,
                 state: ArrayLike, covariance: ArrayLike, amplitude_noise: ArrayLike = 0.0,
                 amplitude: ArrayLike = 1.0, euler_steps: int = 100) -> None:
        if kind not in _KINDS:
            raise ValueError(f"kind {kind!r}; allowed: {', '.join(map(repr, _KINDS))}")
        self._kind = kind
        made, states = _KINDS[kind]
        start, matrix = np.asarray(state, float), np.asarray(covariance, float)
        if start.shape[-1:] != (states,) or matrix.shape[-2:] != (states, states):
            raise ValueError(f"a start of shapes {start.shape} and {matrix.shape}; allowed: ({states},) and "
                             f"({states}, {states}), or these with a batch in front")
        _require(np.isfinite(start), "a start with numbers that are not finite")
        _require(np.isfinite(matrix) & (matrix == np.swapaxes(matrix, -1, -2)),
                 "a covariance that is not finite and symmetric")
        numbers = (interval, measurement_variance, frequency_noise, amplitude_noise)
        self._shape = np.broadcast_shapes(*map(np.shape, (*numbers, amplitude)), start.shape[:-1], matrix.shape[:-2])
        design = _columns(self._shape, *numbers, euler_steps, amplitude)
        _require(np.isfinite(design), "a design with numbers that are not finite")
        _require((design[:, :2] > 0).all() and (design[:, 2:4] >= 0).all() and 1 <= euler_steps <= 10**6,
                 "allowed: interval, measurement_variance > 0, noise >= 0, euler_steps >= 1")
        self._batch = made(design, np.broadcast_to(start, (*self._shape, states)).reshape(-1, states),
                           np.broadcast_to(matrix, (*self._shape, states, states)).reshape(-1, states**2))

    def run(self, samples: ArrayLike, *, threads: int | None = None) -> SineTrack:
        """Tracks a recording.

        Parameters
        ----------
        samples : array_like
            Real, (n,) or (..., n), signal units, none missing.
        threads : int, optional
            The number of threads for a batch; default: one for each core. No result depends on it.

        Returns
        -------
        SineTrack
        """
        state, deviation, _, _ = self._run(_one_channel(samples), 1, threads)
        frequency = state[..., 1 if self._kind in ("phase", "known-amplitude") else 2]
        if self._kind == "squared-frequency":
            frequency = np.sqrt(np.where(frequency >= 0, frequency, np.nan))
        return SineTrack(state, frequency, deviation)


class MedianFilter(_Trackers):
    """The subset averaged median filter of Kang, Song and Lee: removes impulses before a tracker.

    Parameters
    ----------
    window : int
        Inputs, the newest among them; 1 to 32.
    subsets : sequence of sequence of int, optional
        Each an odd number of inputs, counted from 1, the oldest; left out: one with all of them, the median, for
        which `window` is odd.
    weights : sequence of float, optional
        The weights of the medians of the subsets; left out: the same for all, with the sum 1.
    shape : tuple of int
        The shape of the batch: filters with memories of their own.
    """

    def __init__(self, window: int, subsets: Sequence[Sequence[int]] | None = None,
                 weights: Sequence[float] | None = None, *, shape: tuple[int, ...] = ()) -> None:
        chosen = [range(1, window + 1)] if subsets is None else subsets
        _require(1 <= window <= 32 and all(1 <= each <= window for subset in chosen for each in subset),
                 "allowed: a window of 1 to 32 inputs, and subsets of them")
        bits = [float(sum(1 << (each - 1) for each in set(subset))) for subset in chosen]
        given = np.full(len(bits), 1 / max(len(bits), 1)) if weights is None else np.asarray(weights, float)
        _require(given.shape == (len(bits),) and np.isfinite(given), "allowed: a finite weight for each subset")
        self._shape = shape
        self._batch = _trackers.SamBatch(int(np.prod(shape, dtype=int)), window, np.array([bits]), given[np.newaxis])

    def run(self, samples: ArrayLike, *, threads: int | None = None) -> Array:
        """Filters a recording.

        Parameters
        ----------
        samples : array_like
            Real, (n,) or (..., n), none missing. Before the window is full, it is filled with the first one.
        threads : int, optional
            The number of threads for a batch; default: one for each core. No result depends on it.

        Returns
        -------
        ndarray, (..., n)
        """
        return self._run(_one_channel(samples), 1, threads)[0][..., 0]
