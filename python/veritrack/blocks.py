"""The block tracker on recordings; see veritrack.trackers."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _trackers
from .design import Design
from .trackers import Array, _chosen, _columns, _one_channel, _require, _symmetric, _threads, _Trackers

_STATES = np.array(["settling", "lock", "false lock", "no tone"])


@dataclasses.dataclass(frozen=True)
class BlockTrack:
    """The results of a block tracker, for each block: arrays (..., blocks), with the batch in front.

    Attributes
    ----------
    frequency : ndarray
        The estimate with this block, rad/sample.
    deviation : ndarray
        The deviation of the estimate that the filter expects, rad/sample.
    offset : ndarray
        The offset of the frequency from the bin in the middle, bins.
    amplitude : ndarray
        Signal units.
    phase : ndarray
        At the start of the block, rad; not wrapped.
    covariance : ndarray, (..., blocks, 3, 3)
        The covariance of (x1, x2, x3) = (sqrt(amplitude / (4 pi)), phase, offset), as the filter believes.
    lock : ndarray of str
        The lock over the last blocks: "settling" (too few of them), "lock", "false lock" (another offset
        explains more than twice as much of their power) or "no tone".
    unexplained : ndarray
        The share of the bins' power that the estimate does not explain, over the last blocks: 0 in lock without
        noise.
    best_frequency : ndarray
        The frequency of the tone that explains most of the last blocks, to 1/16 bin, rad/sample: where to start again.
    """

    frequency: Array
    deviation: Array
    offset: Array
    amplitude: Array
    phase: Array
    covariance: Array
    lock: NDArray[np.str_]
    unexplained: Array
    best_frequency: Array


class DftBlockEkf(_Trackers):
    """The extended Kalman filter of La Scala and Bitmead that tracks a weak tone from the transforms of blocks.

    Parameters
    ----------
    q1 : array_like
        Process noise variance of x1 = sqrt(amplitude / (4 pi)) per block, signal units; 0 or more.
    q2 : array_like
        Process noise variance of the phase per block, rad^2; 0 or more.
    q3 : array_like
        Process noise variance of the offset per block, bins^2; 0 or more.
    r : array_like
        Variance of the real and of the imaginary part of a bin, signal units squared; above 0. White noise of
        variance s makes s / (2 block_length).
    block_length : int
        Samples in a block, T.
    centre : int
        The bin in the middle, M: tones near 2 pi M / T rad/sample.
    half_width : int
        Bins on either side of it, L; 1 or more, at most M, and 2 (M + L) < T.
    frequency : array_like
        The start frequency, in the first block, rad/sample.
    amplitude : array_like
        The start amplitude, signal units; above 0.
    phase : array_like
        The start phase, at the first sample of the first block, where the signal is amplitude cos(phase), rad.
    covariance : array_like, (..., 3, 3)
        P(1|0) of (x1, x2, x3); the identity when it is left out.
    memory : int
        The number of blocks, about, over which the lock is judged.
    """

    def __init__(self, q1: ArrayLike, q2: ArrayLike, q3: ArrayLike, r: ArrayLike, *, block_length: int, centre: int,
                 half_width: int, frequency: ArrayLike, amplitude: ArrayLike = 1.0, phase: ArrayLike = 0.0,
                 covariance: ArrayLike | None = None, memory: int = 20) -> None:
        _require(half_width >= 1 and half_width <= centre and 2 * (centre + half_width) < block_length and memory >= 1,
                 "allowed: 1 <= half_width <= centre, 2 (centre + half_width) < block_length, memory >= 1")
        self._turn = 2 * math.pi / block_length  # rad/sample in a bin
        self._centre = centre
        covariance = np.eye(3) if covariance is None else covariance
        self._shape = np.broadcast_shapes(*(np.shape(each) for each in (q1, q2, q3, r, frequency, amplitude, phase)),
                                          np.shape(covariance)[:-2])
        design = _columns(self._shape, q1, q2, q3, r)
        _require(np.isfinite(design), "a design with numbers that are not finite")
        _require((design >= 0).all() and (design[:, 3] > 0).all(), "allowed: q1, q2, q3 >= 0, r > 0")
        _require(np.asarray(amplitude, float) > 0, "allowed: amplitude > 0")
        offset = np.asarray(frequency, float) / self._turn - centre
        start = _columns(self._shape, np.sqrt(np.asarray(amplitude, float) / (4 * math.pi)), phase, offset)
        _require(np.isfinite(start), "a start with numbers that are not finite")
        self._batch = _trackers.DftBlockBatch(block_length, centre, half_width, memory, design, start,
                                              _symmetric(covariance, self._shape))

    @classmethod
    def from_design(cls, design: Design, *, frequency: ArrayLike, amplitude: ArrayLike = 1.0, phase: ArrayLike = 0.0,
                    covariance: ArrayLike | None = None, memory: int = 20) -> DftBlockEkf:
        """The tracker of a design file, with the doubles nearest to its decimals.

        Parameters
        ----------
        design : Design
            A design of the tracker "dft-block-ekf", with `block_length` and `centre`.
        frequency, amplitude, phase, covariance, memory
            As for the class.
        """
        chosen = _chosen(design, "dft-block-ekf")
        missing = [key for key in ("block_length", "centre") if key not in chosen]
        if missing:
            raise ValueError(f"a design without {' and '.join(missing)}; allowed: with block_length and centre")
        return cls(float(chosen["q1"]), float(chosen["q2"]), float(chosen["q3"]), float(chosen["r"]),
                   block_length=int(chosen["block_length"]), centre=int(chosen["centre"]),
                   half_width=int(chosen["half_width"]), frequency=frequency, amplitude=amplitude, phase=phase,
                   covariance=covariance, memory=memory)

    @staticmethod
    def start_of(block: ArrayLike, *, centre: int, half_width: int) -> dict[str, float]:
        """A start from the samples of the first block, by the least squares of the thesis, (4.35) and (4.36).

        Parameters
        ----------
        block : array_like
            All samples of one block, signal units.
        centre, half_width : int
            As for the class.

        Returns
        -------
        dict
            `frequency` (rad/sample), `amplitude` (signal units) and `phase` (rad), as the class takes them.
        """
        samples = np.asarray(block, float)
        if samples.ndim != 1 or not np.isfinite(samples).all():
            raise ValueError("a block; allowed: one axis of finite samples")
        root, phase, offset = _trackers.dft_block_start(samples, centre, half_width)
        return {"frequency": 2 * math.pi * (centre + offset) / samples.size, "amplitude": 4 * math.pi * root**2,
                "phase": phase}

    def run(self, samples: ArrayLike, *, threads: int | None = None) -> BlockTrack:
        """Tracks a recording; samples of a block that is not complete are kept for the next call.

        Parameters
        ----------
        samples : array_like
            Real, (n,) or (..., n), signal units, none missing.
        threads : int, optional
            The number of threads for a batch; default: one for each core. No result depends on it.

        Returns
        -------
        BlockTrack
        """
        found = self._batch.run(self._rows(_one_channel(samples), 1), _threads(threads))
        state, covariance, lock = (each.reshape(self._shape + each.shape[1:]) for each in found)
        turn = self._turn
        return BlockTrack(turn * (self._centre + state[..., 2]), turn * np.sqrt(covariance[..., 8]), state[..., 2],
                          4 * math.pi * state[..., 0]**2, state[..., 1],
                          covariance.reshape(*covariance.shape[:-1], 3, 3), _STATES[lock[..., 4].astype(int)],
                          lock[..., 1], turn * (self._centre + lock[..., 2]))
