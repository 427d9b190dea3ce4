// Gaussian noise, and the bound on the probability of losing lock from a set that is proved for it.
#pragma once

#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"
#include "checker/quadrature/lock_step.hpp"

namespace veritrack::checker {

/// A design's assumptions: independent Gaussian noise, at a signal of amplitude 1.
struct GaussianNoise {
  Ball deviation;  ///< sigma of each channel
  Ball walk;       ///< deviation of the frequency's step, rad/sample
  Ball samples;    ///< N
};

/// From `assume`: noise, an object with either snr_db, the signal-to-noise ratio amplitude^2/(2 sigma^2) in
/// dB, or deviation, that of each channel in signal units; frequency_walk; samples. Objects to other members
/// of noise, a deviation that is not positive, a walk that is negative, fewer than one sample, and a slew
/// other than 0. `amplitude` is that of the signal.
GaussianNoise read_gaussian_noise(const Tree& assume, const Ball& amplitude, Objections& objections);

/// For a set without objections from check_lock_set, and starts of a level of at most `start`
/// (lock_start.hpp): an upper bound on the probability that the state leaves the set at one of any N
/// successive samples. At most 1, and 1 where nothing is proved.
Ball probability_of_leaving(const LockSet& set, const Ball& start, const Ball& samples);

/// An upper bound on |frequency error| in the set, rad/sample.
Ball largest_frequency_error(const LockSet& set);

}  // namespace veritrack::checker
