#include "analysis/kkl_observer/rounding/filter_deviation.hpp"

#include <cstddef>
#include <limits>

#include "analysis/kkl_observer/rounding/inverse_rounding.hpp"
#include "analysis/rigor/rounded_functions.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {

namespace {

using rigor::Interval;
using rigor::Rounded;

/// The contribution of the rounding of all steps to each filter, for samples of at most 1 before they are
/// rounded. The steps contract; the bound on one step is for states twice as large as the exact ones get.
template <int M>
KklFilters<M> rounding_of_steps(const rigor::IntervalVector<M>& lambda, const Interval& interval) {
  Eigen::Matrix<Rounded, M, 1> rates;
  Eigen::Matrix<Rounded, M, 1> xi;
  for (Eigen::Index i = 0; i < M; ++i) {
    rates(i) = Rounded(lambda(i));
    xi(i) = Rounded(rigor::symmetric((Interval(2.0) / lambda(i)).upper()));
  }
  const trackers::KklDiscretization<Rounded, M> program(rates, Rounded(interval));
  constexpr double kSample = 1.0 + 0x1p-50;
  const Rounded sample(Interval::from_bounds(-kSample, kSample));
  const auto next = program.interpolated(xi, sample, sample);
  KklFilters<M> result;
  for (Eigen::Index i = 0; i < M; ++i) {
    const Interval forgotten = Interval(1.0) - exp(-(lambda(i) * interval));
    const Interval sum = Interval(next(i).error()) / forgotten;
    // Where the interval is too short to forget anything, the sum is not finite.
    const bool is_known = rigor::certainly_less_equal(sum, Interval(0.5) / lambda(i));
    result[static_cast<std::size_t>(i)] = is_known ? Interval(sum.upper()) : Interval::entire();
  }
  return result;
}

template <int M>
KklFilters<M> sampled_deviation(const KklRobustnessQuestionOf<M>& question, const Interval& interval) {
  constexpr double kRoom = 16.0;  // for a bound by another program
  const auto* bounded = std::get_if<BoundedDisturbance>(&question.disturbance);
  const Interval disturbance = bounded != nullptr ? bounded->bound : Interval(0.0);
  const Interval largest = Interval(question.amplitude.upper()) + disturbance;
  const Interval relative = largest / Interval(question.amplitude.lower());
  const bool in_range = rigor::certainly_less_equal(Interval(kSmallestFilters), largest) &&
                        rigor::certainly_less_equal(largest, Interval(kLargestFilters));
  // A straight line between samples of sin(w t) is off by (w h)^2 / 8 at most, a sample by half a unit.
  const Interval bend = square(Interval(question.range.frequency.upper()) * interval) / Interval(8.0);
  const Interval sample = Interval(Rounded::kUnitRoundoff) * relative;
  KklFilters<M> result = rounding_of_steps<M>(question.range.lambda, interval);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Interval input = bend + sample + Interval(kNeighbourhood);
    const Interval sum =
        input / question.range.lambda(static_cast<Eigen::Index>(i)) + Interval(kRoom) * relative * result[i];
    result[i] = in_range ? Interval(sum.upper()) : Interval::entire();
  }
  return result;
}

}  // namespace

template <int M>
KklFilters<M> filter_deviation(const KklRobustnessQuestionOf<M>& question) {
  rigor::require_upward_rounding();
  KklFilters<M> result;
  result.fill(Interval::entire());
  if (!question.interval) {
    for (std::size_t i = 0; i < result.size(); ++i) {
      const Interval& rate = question.range.lambda(static_cast<Eigen::Index>(i));
      result[i] = Interval((Interval(kAllowedDeviation) / rate).upper());
    }
  } else if (!std::holds_alternative<SinusoidalDisturbance>(question.disturbance)) {
    result = sampled_deviation<M>(question, *question.interval);
  }
  return result;
}

template KklFilters<4> filter_deviation<4>(const KklRobustnessQuestionOf<4>&);
template KklFilters<5> filter_deviation<5>(const KklRobustnessQuestionOf<5>&);
template KklFilters<6> filter_deviation<6>(const KklRobustnessQuestionOf<6>&);
template KklFilters<7> filter_deviation<7>(const KklRobustnessQuestionOf<7>&);
template KklFilters<8> filter_deviation<8>(const KklRobustnessQuestionOf<8>&);

}  // namespace veritrack::kkl_observer
