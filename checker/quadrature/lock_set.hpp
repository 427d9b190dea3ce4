// The set of a certificate of the probability of losing lock: read, and proved.
#pragma once

#include <cstdint>
#include <vector>

#include "checker/document/json_tree.hpp"
#include "checker/quadrature/lock_probability.hpp"
#include "checker/quadrature/lock_step.hpp"
#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// Reads a set and proves, from nothing but the design and its noise: the form and the signs of its numbers;
/// that it is for at least this noise and walk; the drift inequality, with room for rounding, everywhere in
/// it; and that the rounding of a step in double precision stays within that room, for measurements with
/// noise of at most 30 deviations in each channel. Each failure is an objection, and then no statement is
/// made about the set. `cells` counts the cells that were examined. Throws OutOfBudget.
LockSet check_lock_set(const Tree& tree, const Design& design, const GaussianNoise& noise,
                       std::int64_t& cells, Objections& objections);

/// Whether a matrix is [[a, 0, 0], [0, b, c], [0, 0, d]].
bool has_form_of_metric(const Matrix3& metric);

/// Sets for pieces of the band of frequencies, in order: each begins at or before the end of the previous
/// one, and together they cover the band that the design assumes.
bool cover_the_band(const std::vector<LockSet>& sets, const Design& design);

/// The number of deviations within which rounding is bounded.
inline const Ball kMostDeviations(30.0);

/// Whether the rounding of a step from anywhere in the set stays within lock_room(): T times its change of
/// the error is no longer than that, and its change of the covariance adds no more to its level.
bool has_room_for_rounding(const LockSet& set, const Design& design, const Ball& samples);

}  // namespace veritrack::checker
