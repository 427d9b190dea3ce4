#include "analysis/kkl_observer/rounding/estimate_rounding.hpp"

#include <cstddef>

#include "analysis/kkl_observer/rounding/filter_deviation.hpp"
#include "analysis/kkl_observer/rounding/inverse_rounding.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::kkl_observer {

namespace {

using rigor::Interval;

/// An upper bound on the disturbance, signal units.
Interval largest_disturbance(const Disturbance& disturbance) {
  if (const auto* bounded = std::get_if<BoundedDisturbance>(&disturbance)) {
    return bounded->bound;
  }
  const auto* sinusoidal = std::get_if<SinusoidalDisturbance>(&disturbance);
  return sinusoidal != nullptr ? sinusoidal->amplitude : Interval(0.0);
}

}  // namespace

template <int M>
void add_rounding(const KklRobustnessQuestionOf<M>& question, const KklFilters<M>& transient,
                  KklRobustness& result) {
  constexpr double kRoom = 16.0;  // for a bound by another program
  const Interval exact_frequency = result.frequency_error_bound;
  const Interval exact_amplitude = result.amplitude_error_bound;
  result.frequency_error_bound = result.amplitude_error_bound = Interval();
  if (!rigor::is_finite(exact_frequency)) {
    return;
  }
  const Interval lowest(question.amplitude.lower());
  const Interval highest(question.amplitude.upper());
  const Interval slowest(question.range.frequency.lower());
  const Interval disturbance = Interval(largest_disturbance(question.disturbance).upper()) / lowest;
  // |xi| / A at most, and the smallest |xi| that there can be (kNeighbourhood).
  Interval squares(0.0);
  Interval fastest(0.0);
  for (std::size_t i = 0; i < transient.size(); ++i) {
    const Interval& rate = question.range.lambda(static_cast<Eigen::Index>(i));
    squares += square(Interval(1.0) / sqrt(square(rate) + square(slowest)) + disturbance / rate +
                      Interval(rigor::magnitude(transient[i])));
    fastest = max(fastest, rate);
  }
  const Interval longest = sqrt(squares);
  const bool in_range =
      rigor::certainly_less_equal(Interval(kSmallestFilters), lowest * Interval(kNeighbourhood) / fastest) &&
      rigor::certainly_less_equal(highest * longest, Interval(kLargestFilters));
  if (!in_range) {
    return;
  }
  FilterStatesOf<M> states{question.range.lambda, question.ell, result.largest_ell, {}, {}};
  const Interval least = Interval(result.smallest_relative_square.lower()) * square(slowest);
  const Interval most =
      square(Interval(question.range.frequency.upper()) + Interval(exact_frequency.upper()));
  states.squared_frequency = Interval::from_bounds(least.lower(), most.upper());
  states.least_amplitude = Interval(0.0);
  if (rigor::is_finite(exact_amplitude)) {
    const Interval amplitude = (lowest - Interval(exact_amplitude.upper())) / (lowest * longest);
    states.least_amplitude = max(amplitude, states.least_amplitude);
  }
  const InverseRounding rounding = inverse_rounding(states);
  const Interval frequency = Interval(kRoom) * Interval(rounding.frequency);
  if (rigor::is_finite(frequency)) {
    result.rounding = Interval(frequency.upper());
    result.frequency_error_bound = Interval((exact_frequency + frequency).upper());
  }
  const Interval amplitude = Interval(kRoom) * Interval(rounding.amplitude) * highest * longest;
  if (rigor::is_finite(exact_amplitude) && rigor::is_finite(amplitude)) {
    result.amplitude_error_bound = Interval((exact_amplitude + amplitude).upper());
  }
}

template void add_rounding<4>(const KklRobustnessQuestionOf<4>&, const KklFilters<4>&, KklRobustness&);
template void add_rounding<5>(const KklRobustnessQuestionOf<5>&, const KklFilters<5>&, KklRobustness&);
template void add_rounding<6>(const KklRobustnessQuestionOf<6>&, const KklFilters<6>&, KklRobustness&);
template void add_rounding<7>(const KklRobustnessQuestionOf<7>&, const KklFilters<7>&, KklRobustness&);
template void add_rounding<8>(const KklRobustnessQuestionOf<8>&, const KklFilters<8>&, KklRobustness&);

}  // namespace veritrack::kkl_observer
