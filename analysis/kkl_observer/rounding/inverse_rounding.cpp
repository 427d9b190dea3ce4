#include "analysis/kkl_observer/rounding/inverse_rounding.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "analysis/rigor/rounded_functions.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {

namespace {

using rigor::Interval;
using rigor::Rounded;
using trackers::KklResult;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGrowth = 1.25;  ///< of the pieces into which a range is cut

/// Exact values, in real arithmetic.
class Known {
 public:
  Known() { ranges_.fill(Interval::entire()); }
  void set(KklResult which, const Interval& range) { ranges_[static_cast<std::size_t>(which)] = range; }
  [[nodiscard]] Rounded operator()(KklResult which, const Rounded& x) const {
    return {intersection(x.exact(), ranges_[static_cast<std::size_t>(which)]), x.error()};
  }

 private:
  std::array<Interval, static_cast<std::size_t>(KklResult::count)> ranges_;
};

/// All c'xi with |xi| = 1.
template <int M>
Interval linear(const rigor::IntervalVector<M>& c) {
  Interval sum(0.0);
  for (const Interval& x : c) {
    sum += square(x);
  }
  return rigor::symmetric(sqrt(sum).upper());
}

/// The largest lambda^2.
template <int M>
Interval largest_square(const FilterStatesOf<M>& states) {
  Interval largest(0.0);
  for (const Interval& rate : states.lambda) {
    largest = max(largest, square(rate));
  }
  return largest;
}

/// The bounds for every angle between xi and span(lambda, 1); sets `gram` = |lambda|^2 |1|^2 - (lambda'1)^2.
template <int M>
Known known_of(const FilterStatesOf<M>& states, Interval& gram) {
  const auto& lambda = states.lambda;
  const Interval one(1.0);
  Interval sum(0.0);
  Interval squares(0.0);
  gram = Interval(0.0);
  rigor::IntervalVector<M> squared;
  rigor::IntervalVector<M> cubed;
  for (Eigen::Index i = 0; i < M; ++i) {
    squared(i) = square(lambda(i));
    cubed(i) = lambda(i) * squared(i);
    sum += lambda(i);
    squares += squared(i);
    for (Eigen::Index j = i + 1; j < M; ++j) {
      gram += square(lambda(i) - lambda(j));
    }
  }
  rigor::IntervalVector<M> reduced;
  for (Eigen::Index i = 0; i < M; ++i) {
    reduced(i) = squared(i) - sum / squares * cubed(i);
  }
  Known known;
  known.set(KklResult::squared_norm, one);
  known.set(KklResult::excess,
            Interval::from_bounds(
                -kInfinity, (Interval(states.ell.upper()) - Interval(states.largest_ell.lower())).upper()));
  known.set(KklResult::entry_13, linear<M>(lambda));
  known.set(KklResult::entry_23, rigor::symmetric(sqrt(Interval(static_cast<double>(M))).upper()));
  known.set(KklResult::entry_33, one);
  known.set(KklResult::right_1, linear<M>(cubed));
  known.set(KklResult::right_2, linear<M>(squared));
  known.set(KklResult::right_3, rigor::symmetric(largest_square(states).upper()));
  // -xi times the part of 1 orthogonal to lambda, whose square is gram / |lambda|^2.
  known.set(KklResult::reduced_23, rigor::symmetric(sqrt(gram / squares).upper()));
  known.set(KklResult::reduced_2, linear<M>(reduced));
  known.set(KklResult::x3, states.squared_frequency);
  return known;
}

/// Enlarges `worst` by the errors of the estimate from a computed state. With the exact amplitude cut into
/// pieces [a, b], the exact |x1| <= b, |x2| <= b w.
template <int M>
void look(const trackers::OscillatorState<Rounded>& x, const FilterStatesOf<M>& states, Known& known,
          InverseRounding& worst) {
  const Interval most = sqrt(square(x(0).exact()) + square(x(1).exact()) / states.squared_frequency);
  const double top = most.upper();
  const double bottom = states.least_amplitude.lower();
  if (!(bottom > 0.0 && bottom < top && top < kInfinity)) {
    worst.amplitude = kInfinity;
  }
  double low = std::min(bottom, top);
  do {
    const double high = std::min(rigor::mul_up(kGrowth, low), top);
    const Interval reach = rigor::symmetric(high);
    const auto within = [](const Rounded& value, const Interval& range) {
      return Rounded(intersection(value.exact(), range), value.error());
    };
    known.set(KklResult::squared_amplitude, square(Interval::from_bounds(low, high)));
    const trackers::OscillatorState<Rounded> here{within(x(0), reach),
                                                  within(x(1), reach * sqrt(states.squared_frequency)), x(2)};
    const auto estimate = trackers::in_engineering_units(here, known);
    worst.frequency = std::max(worst.frequency, estimate.frequency.error());
    worst.amplitude = std::max(worst.amplitude, estimate.amplitude.error());
    low = high;
  } while (low < top && worst.amplitude < kInfinity);
}

}  // namespace

template <int M>
InverseRounding inverse_rounding(const FilterStatesOf<M>& states) {
  rigor::require_upward_rounding();
  const InverseRounding none{kInfinity, kInfinity};
  Interval gram;
  Known known = known_of(states, gram);
  trackers::KklObserverDesign<Rounded, M> design;
  Eigen::Matrix<Rounded, M, 1> xi;
  for (Eigen::Index i = 0; i < M; ++i) {
    design.lambda(i) = Rounded(states.lambda(i));
    xi(i) = Rounded(Interval::from_bounds(-1.0, 1.0));
  }
  design.ell = Rounded(states.ell);
  // With a mu that is only nearly zero, (L'L + mu I) does not scale with xi.
  const Rounded mu = trackers::kkl_regularization<Rounded, M>(xi, design, known);
  if (!(mu.error() == 0.0 && rigor::identical(mu.exact(), Interval(0.0)))) {
    return none;
  }
  // d3 = |N'xi|^2 = |M xi|^2 / gram is at most 1, and x3 d3 = -xi'NN'F^2 xi at most max lambda^2 sqrt(d3).
  double low = (Interval(states.largest_ell.lower()) / (Interval(2.0) * gram)).lower();
  const Interval reach = square(largest_square(states) / Interval(states.squared_frequency.lower()));
  const double top = std::min(1.0, reach.upper());
  if (!(low > 0.0 && low < top)) {
    return none;
  }
  // Cut into pieces on each of which z3 = x3 d3 is known well.
  InverseRounding worst{0.0, 0.0};
  while (low < top && worst.frequency < kInfinity) {
    const double high = std::min(rigor::mul_up(kGrowth, low), top);
    const Interval piece = Interval::from_bounds(low, high);
    known.set(KklResult::reduced_33, piece);
    known.set(KklResult::reduced_3, piece * states.squared_frequency);
    const auto x = trackers::kkl_inverse<Rounded, M>(xi, design, known);
    look(x, states, known, worst);
    low = high;
  }
  return worst;
}

template InverseRounding inverse_rounding<4>(const FilterStatesOf<4>&);
template InverseRounding inverse_rounding<5>(const FilterStatesOf<5>&);
template InverseRounding inverse_rounding<6>(const FilterStatesOf<6>&);
template InverseRounding inverse_rounding<7>(const FilterStatesOf<7>&);
template InverseRounding inverse_rounding<8>(const FilterStatesOf<8>&);

}  // namespace veritrack::kkl_observer
