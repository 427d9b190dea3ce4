"""The trackers on recordings: NumPy arrays in, NumPy arrays out.

The code that runs is that of the folder trackers/, which is what certificates are about. One call takes a whole
recording, and a batch of trackers at once: parameters that are arrays make a batch of their common shape. The
interpreter is free meanwhile, and its rounding mode and exception flags are as they were afterwards. Trackers
keep their memory: a second call goes on where the first one ended.

Frequencies are in rad/sample unless it says rad/s.
"""

from __future__ import annotations

import copy
import dataclasses
import os
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _trackers
from ._trackers import ZeroInnovationVariance
from .design import Design

__all__ = ["KklObserver", "KklTrack", "NotchTrack", "QuadratureBatch", "QuadratureEkf", "QuadratureNotch", "RealNotch",
           "SingleChannelEkf", "ToneTrack", "ZeroInnovationVariance"]

Array = NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class ToneTrack:
    """The results of an extended Kalman filter, for each sample: arrays (..., n), with the batch in front.

    Attributes
    ----------
    frequency : ndarray
        The estimate with this sample, rad/sample.
    deviation : ndarray
        The deviation of the estimate that the filter expects, rad/sample.
    phasor : ndarray of complex
        In-phase and quadrature part, signal units.
    innovation : ndarray
        Sample less prediction, signal units; complex with two channels. NaN where a sample is missing.
    nis : ndarray
        The normalised innovation squared: chi-squared with as many degrees of freedom as channels when the
        filter's belief is right.
    """

    frequency: Array
    deviation: Array
    phasor: NDArray[np.complex128]
    innovation: NDArray[Any]
    nis: Array


@dataclasses.dataclass(frozen=True)
class KklTrack:
    """The results of a KKL observer, for each sample: arrays (..., n). NaN where its estimate is no frequency.

    Attributes
    ----------
    frequency : ndarray
        rad/s.
    amplitude : ndarray
        Signal units.
    phase : ndarray
        rad: the signal is amplitude sin(phase).
    """

    frequency: Array
    amplitude: Array
    phase: Array


@dataclasses.dataclass(frozen=True)
class NotchTrack:
    """The results of an adaptive notch filter, for each sample: arrays (..., n).

    Attributes
    ----------
    frequency : ndarray
        rad/sample.
    error : ndarray
        The sample after the notch, signal units; complex with two channels.
    """

    frequency: Array
    error: NDArray[Any]


def _columns(shape: tuple[int, ...], *parameters: ArrayLike) -> Array:
    """Parameters as the columns of a table with a row for each tracker."""
    return np.stack([np.broadcast_to(np.asarray(each, float), shape).ravel() for each in parameters], axis=-1)


def _require(condition: Any, what: str) -> None:
    if not np.all(condition):
        raise ValueError(what)


def _threads(threads: int | None) -> int:
    if threads is not None and threads < 1:
        raise ValueError(f"threads {threads}; allowed: 1 or more")
    return threads or len(os.sched_getaffinity(0))


class _Trackers:
    """A batch of trackers of one kind."""

    _shape: tuple[int, ...]
    _batch: Any

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the batch; () for one tracker."""
        return self._shape

    def copy(self):
        """Copies of the trackers with their memory, independent of the originals."""
        other = copy.copy(self)
        other._batch = copy.copy(self._batch)
        return other

    def _rows(self, samples: Array, channels: int) -> Array:
        """Samples (n, channels) for all, or (*shape, n, channels), as one row or a row for each tracker."""
        if samples.ndim == 2:
            return samples[np.newaxis]
        try:
            rows = np.broadcast_to(samples, self._shape + samples.shape[-2:])
        except ValueError:
            raise ValueError(f"samples of shape {samples.shape[:-1]}; allowed: (n,), or the shape of the batch, "
                             f"{self._shape}, and n") from None
        return rows.reshape(-1, *samples.shape[-2:]) if channels else rows

    def _run(self, samples: Array, channels: int, threads: int | None) -> tuple[Array, Array, Array, Array]:
        found = self._batch.run(self._rows(samples, channels), _threads(threads))
        return tuple(each.reshape(self._shape + each.shape[1:]) for each in found)  # type: ignore[return-value]


def _two_channels(samples: ArrayLike) -> Array:
    """Complex samples, or pairs of in-phase and quadrature part, as pairs."""
    array = np.asarray(samples)
    if np.iscomplexobj(array):
        return np.ascontiguousarray(array, np.complex128).view(np.float64).reshape(*array.shape, 2)
    if array.ndim < 2 or array.shape[-1] != 2:
        raise ValueError(f"samples of shape {array.shape}; allowed: complex, or real with two numbers for each "
                         "sample, in phase and in quadrature")
    return np.asarray(array, np.float64)


def _one_channel(samples: ArrayLike) -> Array:
    array = np.asarray(samples)
    if np.iscomplexobj(array) or array.ndim == 0:
        raise ValueError("samples of one channel; allowed: an array of real numbers")
    return np.asarray(array, np.float64)[..., np.newaxis]


def _complex(pairs: Array) -> NDArray[np.complex128]:
    """Pairs as complex numbers of their own precision."""
    return np.ascontiguousarray(pairs).view(np.result_type(pairs.dtype, np.complex64))[..., 0]


class _ToneFilter(_Trackers):
    """Common parts of both extended Kalman filters."""

    @property
    def state(self) -> Array:
        """(x1, x2, x3), filtered: in-phase and quadrature part in signal units, frequency in rad/sample."""
        return self._batch.estimates()[0].reshape(*self._shape, 3)

    @property
    def covariance(self) -> Array:
        """The covariance of the filtered state that the filter expects."""
        return self._batch.estimates()[1].reshape(*self._shape, 3, 3)

    def _track(self, samples: Array, threads: int | None) -> ToneTrack:
        channels = samples.shape[-1]
        state, deviation, innovation, nis = self._run(samples, channels, threads)
        return ToneTrack(state[..., 2], deviation, _complex(np.ascontiguousarray(state[..., :2])),
                         _complex(innovation) if channels == 2 else innovation[..., 0], nis)


def _start(shape: tuple[int, ...], phasor: ArrayLike, frequency: ArrayLike,
           covariance: ArrayLike) -> tuple[Array, Array]:
    phasor = np.asarray(phasor, complex)
    return _columns(shape, phasor.real, phasor.imag, frequency), _symmetric(covariance, shape)


def _symmetric(covariance: ArrayLike, shape: tuple[int, ...]) -> Array:
    """Covariances of (3, 3), a row of nine numbers for each tracker."""
    matrix = np.asarray(covariance, float)
    if matrix.shape[-2:] != (3, 3):
        raise ValueError(f"a covariance of shape {matrix.shape}; allowed: (3, 3), or that with a batch in front")
    _require(np.isfinite(matrix) & (matrix == np.swapaxes(matrix, -1, -2)),
             "a covariance that is not finite and symmetric")
    return np.broadcast_to(matrix, (*shape, 3, 3)).reshape(-1, 9)


class QuadratureEkf(_ToneFilter):
    """The extended Kalman filter of La Scala and Bitmead, which sees both channels.

    Parameters
    ----------
    q1 : array_like
        Process noise variance of in-phase and quadrature part, signal units squared; 0 or more.
    q2 : array_like
        Process noise variance of the frequency, (rad/sample)^2; above 0.
    r : array_like
        Measurement noise variance of each channel, signal units squared; above 0.
    epsilon : array_like
        Leak of the frequency towards zero per sample; from 0, below 1.
    frequency : array_like
        The start frequency, one sample before the recording, rad/sample.
    phasor : array_like of complex
        The start amplitudes, signal units.
    covariance : array_like, (..., 3, 3)
        P(0|0) of the state (in phase, quadrature, frequency); the identity when it is left out. With a
        certificate: the matrix that it prints, turned into the phase of the phasor.
    """

    _kind: Any = _trackers.QuadratureBatch

    def __init__(self, q1: ArrayLike, q2: ArrayLike, r: ArrayLike, epsilon: ArrayLike = 0.0, *,
                 frequency: ArrayLike, phasor: ArrayLike = 1.0, covariance: ArrayLike | None = None) -> None:
        covariance = np.eye(3) if covariance is None else covariance
        self._shape = np.broadcast_shapes(*(np.shape(each) for each in (q1, q2, r, epsilon, frequency, phasor)),
                                          np.shape(covariance)[:-2])
        design = _columns(self._shape, q1, q2, r, epsilon)
        _require(np.isfinite(design), "a design with numbers that are not finite")
        _require((design[:, 0] >= 0) & (design[:, 1] > 0) & (design[:, 2] > 0), "allowed: q1 >= 0, q2 > 0, r > 0")
        _require((design[:, 3] >= 0) & (design[:, 3] < 1), "allowed: 0 <= epsilon < 1")
        self._batch = self._kind(
            design, *_start(self._shape, phasor, frequency, covariance))

    @classmethod
    def from_design(cls, design: Design, *, frequency: ArrayLike, phasor: ArrayLike = 1.0,
                    covariance: ArrayLike | None = None) -> QuadratureEkf:
        """The filter of a design file, with the doubles nearest to its decimals.

        Parameters
        ----------
        design : Design
            A design of the tracker "quadrature-ekf".
        frequency, phasor, covariance
            The start, as for the class.
        """
        chosen = _chosen(design, "quadrature-ekf")
        return cls(float(chosen["q1"]), float(chosen["q2"]), float(chosen["r"]), float(chosen["epsilon"]),
                   frequency=frequency, phasor=phasor, covariance=covariance)

    def run(self, samples: ArrayLike, *, threads: int | None = None) -> ToneTrack:
        """Tracks a recording.

        Parameters
        ----------
        samples : array_like
            Complex, (n,) for all trackers or (..., n) with the shape of the batch in front; or real with a last
            axis of two numbers, in phase and in quadrature. Signal units. NaN is a sample that is missing: the
            filter predicts.
        threads : int, optional
            The number of threads for a batch; default: one for each core. No result depends on it.

        Returns
        -------
        ToneTrack
        """
        return self._track(_two_channels(samples), threads)


class QuadratureBatch(QuadratureEkf):
    """Many filters of La Scala and Bitmead side by side: several in one register of the processor.

    Results and memory are those of QuadratureEkf; 32 filters or more are worth it. The widest
    instructions that the processor has are used (AVX-512, AVX2 or SSE2), and all of them give the same bits.
    From those of QuadratureEkf results differ by rounding: sine and cosine are within one unit in the last
    place here, too, but not always the same double. A certificate of the filter covers both.

    Parameters
    ----------
    q1, q2, r, epsilon, frequency, phasor, covariance
        As for QuadratureEkf.
    dtype : dtype
        numpy.float64, or numpy.float32 for twice as many filters in a register: parameters and samples are
        rounded to single precision, and so is each operation. Tracks are then arrays of numpy.float32 and
        numpy.complex64. Certificates about double precision do not cover it.
    """

    def __init__(self, q1: ArrayLike, q2: ArrayLike, r: ArrayLike, epsilon: ArrayLike = 0.0, *,
                 frequency: ArrayLike, phasor: ArrayLike = 1.0, covariance: ArrayLike | None = None,
                 dtype: DTypeLike = np.float64) -> None:
        kinds = {np.dtype(np.float64): _trackers.PackedQuadratureBatch,
                 np.dtype(np.float32): _trackers.SinglePackedQuadratureBatch}
        if np.dtype(dtype) not in kinds:
            raise ValueError(f"dtype {np.dtype(dtype)}; allowed: float32, float64")
        self._kind = kinds[np.dtype(dtype)]
        super().__init__(q1, q2, r, epsilon, frequency=frequency, phasor=phasor, covariance=covariance)


class SingleChannelEkf(_ToneFilter):
    """The extended Kalman filter of Bittanti and Savaresi, which sees one channel.

    Parameters
    ----------
    process_noise : array_like, (..., 3, 3)
        Q; `q * numpy.eye(3)` and `q * numpy.diag([0, 0, 1])` are the paper's two readings.
    r : array_like
        Measurement noise variance, signal units squared; 0 or more.
    epsilon : array_like
        Leak of the frequency towards zero per sample; from 0, below 1.
    frequency, phasor, covariance
        The start, as for QuadratureEkf.
    """

    def __init__(self, process_noise: ArrayLike, r: ArrayLike, epsilon: ArrayLike = 0.0, *,
                 frequency: ArrayLike, phasor: ArrayLike = 1.0, covariance: ArrayLike | None = None) -> None:
        covariance = np.eye(3) if covariance is None else covariance
        noise = np.asarray(process_noise, float)
        if noise.shape[-2:] != (3, 3):
            raise ValueError(f"a process noise of shape {noise.shape}; allowed: (3, 3)")
        self._shape = np.broadcast_shapes(*(np.shape(each) for each in (r, epsilon, frequency, phasor)),
                                          noise.shape[:-2], np.shape(covariance)[:-2])
        design = _columns(self._shape, r, epsilon)
        _require(np.isfinite(design) & (design >= 0), "allowed: r >= 0")
        _require(design[:, 1] < 1, "allowed: 0 <= epsilon < 1")
        _require(np.isfinite(noise) & (noise == np.swapaxes(noise, -1, -2)),
                 "a process noise that is not finite and symmetric")
        self._batch = _trackers.SingleChannelBatch(
            np.broadcast_to(noise, (*self._shape, 3, 3)).reshape(-1, 9), design,
            *_start(self._shape, phasor, frequency, covariance))

    def run(self, samples: ArrayLike, *, threads: int | None = None) -> ToneTrack:
        """Tracks a recording.

        Parameters
        ----------
        samples : array_like
            Real, (n,) for all trackers or (..., n) with the shape of the batch in front; signal units. NaN is a
            sample that is missing: the filter predicts.
        threads : int, optional
            The number of threads for a batch; default: one for each core. No result depends on it.

        Returns
        -------
        ToneTrack

        Raises
        ------
        ZeroInnovationVariance
            With r = 0 and a prediction that is certain of the sample; no tracker of the batch has moved then.
        """
        return self._track(_one_channel(samples), threads)


class KklObserver(_Trackers):
    """The observer of Praly, Marconi and Isidori on samples, along straight lines between them, from rest.

    Parameters
    ----------
    rates : array_like, (..., m)
        The rates of the filters, 1/s; four to eight, above 0 and distinct.
    ell : array_like
        The constant of (9) of the paper; 0 or more.
    interval : array_like
        The time between samples, s; above 0.
    """

    def __init__(self, rates: ArrayLike, ell: ArrayLike, interval: ArrayLike) -> None:
        table = np.asarray(rates, float)
        count = table.shape[-1] if table.ndim else 0
        if not 4 <= count <= 8:
            raise ValueError(f"{count} filter rates; allowed: four to eight")
        ordered = np.sort(table, axis=-1)
        _require(np.isfinite(table) & (ordered > 0), "allowed: filter rates above 0")
        _require(np.diff(ordered, axis=-1) > 0, "allowed: filter rates that are distinct")
        self._shape = np.broadcast_shapes(table.shape[:-1], np.shape(ell), np.shape(interval))
        design = _columns(self._shape, ell, interval)
        _require(np.isfinite(design) & (design >= 0) & (design[:, 1:] > 0), "allowed: ell >= 0, interval > 0")
        self._batch = getattr(_trackers, f"KklBatch{count}")(
            np.broadcast_to(table, (*self._shape, count)).reshape(-1, count), design)

    def run(self, samples: ArrayLike, *, threads: int | None = None) -> KklTrack:
        """Tracks a recording.

        Parameters
        ----------
        samples : array_like
            Real, (n,) or (..., n), signal units, none missing.
        threads : int, optional
            The number of threads for a batch; default: one for each core. No result depends on it.

        Returns
        -------
        KklTrack
        """
        state = self._run(_one_channel(samples), 1, threads)[0]
        return KklTrack(state[..., 2], state[..., 0], state[..., 1])


class _Notch(_Trackers):
    _kind: Any

    def __init__(self, rho: ArrayLike, mu: ArrayLike, p: ArrayLike = 2.0, *, frequency: ArrayLike) -> None:
        self._shape = np.broadcast_shapes(*(np.shape(each) for each in (rho, mu, p, frequency)))
        design = _columns(self._shape, rho, mu, p, frequency)
        _require(np.isfinite(design), "a design with numbers that are not finite")
        _require((design[:, 0] > 0) & (design[:, 0] < 1), "allowed: 0 < rho < 1")
        _require((design[:, 1] >= 0) & (design[:, 2] >= 1), "allowed: mu >= 0, p >= 1")
        self._batch = self._kind(design)


class RealNotch(_Notch):
    """The adaptive notch filter of Pei and Tseng for one channel, by least mean p-th power.

    Parameters
    ----------
    rho : array_like
        Radius of the poles, in (0, 1); close to 1 is narrow.
    mu : array_like
        Step of the gradient; 0 or more.
    p : array_like
        Power of the error that is minimised; 1 or more.
    frequency : array_like
        The first estimate, rad/sample, in (0, pi).
    """

    _kind = _trackers.RealNotchBatch

    def run(self, samples: ArrayLike, *, threads: int | None = None) -> NotchTrack:
        """Tracks a recording.

        Parameters
        ----------
        samples : array_like
            Real, (n,) or (..., n), signal units, none missing.
        threads : int, optional
            The number of threads for a batch; default: one for each core. No result depends on it.

        Returns
        -------
        NotchTrack
        """
        state = self._run(_one_channel(samples), 1, threads)[0]
        return NotchTrack(state[..., 0], state[..., 1])


class QuadratureNotch(_Notch):
    """The same for two channels; parameters as for RealNotch, and any first frequency, rad/sample."""

    _kind = _trackers.QuadratureNotchBatch

    def run(self, samples: ArrayLike, *, threads: int | None = None) -> NotchTrack:
        """Tracks a recording.

        Parameters
        ----------
        samples : array_like
            Complex, or pairs, as for QuadratureEkf.run; none missing.
        threads : int, optional
            The number of threads for a batch; default: one for each core. No result depends on it.

        Returns
        -------
        NotchTrack
        """
        state = self._run(_two_channels(samples), 2, threads)[0]
        return NotchTrack(state[..., 0], _complex(np.ascontiguousarray(state[..., 1:])))


def _chosen(design: Design, tracker: str) -> dict[str, Any]:
    if design.tracker != tracker:
        raise ValueError(f"a design of the tracker {design.tracker}; allowed: {tracker}")
    return {"epsilon": 0, **design.values["design"]}
