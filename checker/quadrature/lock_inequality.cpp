#include "checker/quadrature/lock_inequality.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace veritrack::checker {

namespace {

namespace proposal = lock_proposal;

constexpr std::size_t kCorners = kLockCorners / 2;

void scale(SquareMatrix<lock_form::kSize>& m, const lock_form::Factors<Ball>& factors, bool by_size) {
  for (std::size_t i = 0; i < lock_form::kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (const Ball* factor = lock_form::factor_at(factors, i, j)) {
        m[i][j] = (by_size ? abs(*factor) : *factor) * m[i][j];
      }
    }
  }
}

}  // namespace

/// The matrix at the two ends of s, and roughly.
struct LockInequality::Forms {
  Forms(const LockBox& box, const LockStep& step, const Metric& next, const LockSet& set,
        const LockFilter& filter) {
    const lock_form::Parts parts = lock_form::parts_of(step, next, set.deviation, filter.r);
    for (std::size_t end = 0; end < 2; ++end) {
      over[end] = over_box<lock_form::kSize>(parts.value, parts.slope, box.ends[end], box.half_widths);
      rough.parts[end] = proposal::near(over[end].centre);
    }
  }
  /// For a multiplier, with the rest taken off.
  void finish(const SquareMatrix<lock_form::kSize>& constant, const lock_form::Factors<Ball>& factors,
              const std::array<double, lock_form::kSize>& weights) {
    for (OverBox<lock_form::kSize>& form : over) {
      scale(form.centre, factors, false);
      for (SquareMatrix<lock_form::kSize>& way : form.ways) {
        scale(way, factors, false);
      }
      scale(form.rest, factors, true);
      for (std::size_t i = 0; i < lock_form::kRest; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
          form.centre[i][j] += constant[i][j];
        }
      }
      take_rest(form, weights);
    }
  }

  std::array<OverBox<lock_form::kSize>, 2> over;
  proposal::Ends rough;
};

LockInequality::LockInequality(const LockFilter& filter, const LockSet& set, LockLeft left)
    : filter_(filter),
      set_(set),
      left_(std::move(left)),
      levels_(set, with_lock_room(set.metric)),
      rough_deviation_(set.deviation.near()),
      rough_r_(filter.r.near()) {
  // I - w^2 (S e3)(S e3)' in the rows of the error.
  const std::array<Ball, 3> t3{zero, left_.next.coupling, left_.next.frequency};
  const Ball walked = square(set.walk);
  for (std::size_t i = 0; i < lock_form::kRest; ++i) {
    constant_[i][i] = one;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      constant_[i][j] -= walked * t3[i] * t3[j];
    }
  }
  walk_loss_ = log(one - walked * (square(t3[1]) + square(t3[2])));
  rough_constant_ = proposal::near(constant_);
}

bool LockInequality::outside(const LockCell& cell) const {
  Ball twice;
  for (std::size_t i = 0; i < 4; ++i) {
    const double least = cell.low[i] > 0.0 ? cell.low[i] : cell.high[i] < 0.0 ? cell.high[i] : 0.0;
    twice += i == 3 ? set_.weight * square(Ball(least)) : square(Ball(least));
  }
  return certainly_less(two * set_.level, twice);
}

bool LockInequality::seems_to_fail(const LockBox& box, const LockStep& step, const Forms& forms) const {
  const double twice = near_twice_level(set_, box);
  const double rest = left_.near_middle(box, levels_.near_middle(step)) + walk_loss_.near();
  proposal::Ends middle{forms.rough.parts, {rest, rest}};
  for (std::size_t i = 0; i < lock_form::kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      middle.parts[0][i][j] = 0.5 * (forms.rough.parts[0][i][j] + forms.rough.parts[1][i][j]);
    }
  }
  middle.parts[1] = middle.parts[0];
  const double multiplier = proposal::propose_multiplier(middle, rough_constant_, rough_deviation_, rough_r_);
  const double left = proposal::left_over(proposal::form(
      middle.parts[0], rough_constant_, rest, lock_form::factors_of(multiplier, rough_deviation_, rough_r_)));
  return twice <= 2.0 * set_.level.near() && !(left > 0.0);
}

LockLook LockInequality::look(const LockCell& cell) const {
  const LockBox box(cell.low, cell.high);
  LockLook found;
  // A matter of speed: along s tangents lose less than chords along u.
  std::array<double, 4> influence{};
  for (std::size_t i = 0; i < kSides; ++i) {
    influence[i] = std::pow(box.half_widths[i].near(), 2);
  }
  influence[kSides] = 0.25 * set_.weight.near() * std::pow(box.ends[1].near(), 2);
  found.side = static_cast<std::size_t>(
      std::distance(influence.begin(), std::max_element(influence.begin(), influence.end())));
  LockStep step = lock_step(filter_, set_, box.u, box.level);
  for (std::size_t i = 0; i < kSides; ++i) {
    step.mean[i] = step.mean[i] - left_.offset[i];
  }
  // The matrix is affine in the frequency, so that the ends of its range decide.
  std::vector<Forms> forms;
  for (const Ball& way : {step.reach, -step.reach}) {
    LockStep at_end = step;
    at_end.mean[2] = at_end.mean[2] + way;
    forms.emplace_back(box, at_end, left_.next, set_, filter_);
    found.hopeless = seems_to_fail(box, at_end, forms.back());
    if (found.hopeless) {
      return found;
    }
    if (certainly_equal(step.reach, zero)) {
      break;
    }
  }
  LockCorners levels;
  if (!levels_.find(box, step, levels)) {
    return found;
  }
  LockCorners rest = left_.at_corners(box, levels);
  for (Ball& corner : rest) {
    corner += walk_loss_;
  }
  found.proved = std::all_of(forms.begin(), forms.end(), [&](Forms& at_end) { return proves(at_end, rest); });
  return found;
}

bool LockInequality::proves(Forms& forms, const LockCorners& rest) const {
  const auto middle_of = [&](std::size_t end) {
    double sum = 0.0;
    for (std::size_t corner = 0; corner < kCorners; ++corner) {
      sum += rest[corner + kCorners * end].near() / static_cast<double>(kCorners);
    }
    return sum;
  };
  forms.rough.rest = {middle_of(0), middle_of(1)};
  const double multiplier =
      proposal::propose_multiplier(forms.rough, rough_constant_, rough_deviation_, rough_r_);
  if (!(multiplier > 0.0) || !std::isfinite(multiplier)) {
    return false;
  }
  const auto rough_factors = lock_form::factors_of(multiplier, rough_deviation_, rough_r_);
  forms.finish(constant_, lock_form::factors_of(Ball(multiplier), set_.deviation, filter_.r),
               proposal::propose_weights(proposal::form(forms.rough.parts[1], rough_constant_,
                                                        forms.rough.rest[1], rough_factors)));
  for (std::size_t k = 0; k < kLockCorners; ++k) {
    SquareMatrix<lock_form::kSize> n = at_corner(forms.over[k / kCorners], k % kCorners);
    n[lock_form::kRest][lock_form::kRest] += rest[k];
    if (!(proposal::left_over(proposal::near(n)) > 0.0) ||
        !certainly_positive(lock_form::left_over(std::move(n)))) {
      return false;
    }
  }
  return true;
}

}  // namespace veritrack::checker
