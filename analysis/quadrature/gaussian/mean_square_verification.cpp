#include "analysis/quadrature/gaussian/mean_square_verification.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/quadrature/gaussian/lock_cover.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// True only when all numbers are in their ranges.
bool is_in_range(const LockMeanSquare& form) {
  const Interval frequency(form.metric.frequency);
  return certainly_positive(Interval(form.metric.amplitude)) &&
         certainly_positive(Interval(form.metric.phase)) && certainly_positive(frequency) &&
         is_finite(Interval(form.metric.coupling)) && certainly_positive(Interval(form.weight)) &&
         std::all_of(form.offset.begin(), form.offset.end(), [](double x) { return std::isfinite(x); }) &&
         certainly_not_negative(Interval(form.share)) && certainly_positive(Interval(form.rate)) &&
         certainly_positive(Interval(form.bound)) &&
         // The remainder of the errors is convex.
         certainly_less_equal(Interval(form.rate), rigor::square(frequency));
}

std::optional<std::int64_t> cells_of(const trackers::ToneModel<Interval>& design, const LockSet& set,
                                     const LockMeanSquare& proposal, const CoverLimits& limits) {
  if (!is_in_range(proposal)) {
    return std::nullopt;
  }
  const MeanSquareInequality inequality(design, set, proposal);
  const bool mirrors =
      has_mirror_image(design, set) && proposal.offset[1] == 0.0 && proposal.offset[2] == 0.0;
  return cells_of_proof(
      set, mirrors, [&](const LevelCell& cell) { return inequality.check(cell); }, limits);
}

}  // namespace

LockVerification verify_mean_square(const trackers::ToneModel<Interval>& design, const LockSet& set,
                                    const LockMeanSquare& proposal, std::int64_t most_cells) {
  const rigor::UpwardRounding upward;
  CoverLimits limits;
  limits.cells_in_part = most_cells;
  const auto cells = cells_of(design, set, proposal, limits);
  return cells
             ? LockVerification{Verdict::proved, "the mean square is bounded in every cell.", *cells}
             : LockVerification{Verdict::undecided,
                                "somewhere in the set the mean square could not be shown to be bounded.", 0};
}

bool expects_cells(const trackers::ToneModel<Interval>& design, const LockSet& set,
                   const LockMeanSquare& proposal, std::size_t every, std::int64_t most_cells) {
  const rigor::UpwardRounding upward;
  const auto share = most_cells / static_cast<std::int64_t>(every);
  return cells_of(design, set, proposal, {share, share, every}).has_value();
}

Interval expected_form(const LockSet& set, const LockMeanSquare& mean_square,
                       const Interval& expected_weight) {
  const Interval weight = max(expected_weight, rigor::exp(Interval(1.0)));
  const Interval twice_level = Interval(2.0) * rigor::log(weight);
  const Interval length = rigor::sqrt(relative_norm_squared(mean_square, set) * twice_level);
  return Interval(mean_square.share) * weight + rigor::square(length + offset_length(mean_square)) +
         Interval(mean_square.weight) / Interval(set.weight) * twice_level;
}

}  // namespace veritrack::quadrature
