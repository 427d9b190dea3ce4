#include "analysis/kkl_observer/kkl_robustness.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "analysis/kkl_observer/kkl_bounded_errors.hpp"
#include "analysis/kkl_observer/kkl_settling.hpp"
#include "analysis/kkl_observer/kkl_sinusoidal_errors.hpp"
#include "analysis/kkl_observer/rounding/estimate_rounding.hpp"
#include "analysis/kkl_observer/rounding/filter_deviation.hpp"
#include "analysis/search/branch_and_bound.hpp"

namespace veritrack::kkl_observer {

namespace {

using rigor::Interval;
using Filters = KklErrorMap<Interval>::Filters<Interval>;

template <typename Errors>
KklRobustness search_errors(const Errors& errors, const KklRobustnessQuestion& question) {
  KklRobustness result;
  const auto minimize = [&](double tolerance, double sufficient, const auto& function) {
    search::BranchAndBoundSettings<kKklSearchVariables> settings;
    settings.relative_tolerance = tolerance;
    settings.sufficient = sufficient;
    settings.cells = question.cells;
    settings.batch = 256;
    settings.importance = errors.importance();
    settings.of_lower_ends = true;  // the remaining effect of the start lies anywhere in its intervals
    auto minimum = search::minimize_globally<kKklSearchVariables>(function, errors.box(), settings);
    result.cells += minimum.cells;
    return minimum;
  };
  // The largest size of an error: minus the least of both signs.
  const auto bound = [&](const auto& error, auto& worst) {
    double least = 0.0;
    double reached = 0.0;
    double sufficient = std::numeric_limits<double>::infinity();
    for (const double sign : Errors::kSigns) {
      const auto minimum = minimize(question.relative_tolerance, sufficient,
                                    [&](const auto& v) { return error(v) * Interval(sign); });
      least = std::min(least, minimum.lower);
      sufficient = least;
      if (minimum.upper < reached) {
        reached = minimum.upper;
        worst = minimum.best;
      }
    }
    return Interval(-least);
  };
  const auto ratio =
      minimize(0.2, std::numeric_limits<double>::infinity(), [&](const auto& v) { return errors.ratio(v); });
  result.largest_ell = Interval(2.0) * Interval(ratio.lower);
  const auto square = minimize(0.2, std::numeric_limits<double>::infinity(),
                               [&](const auto& v) { return errors.relative_square(v); });
  result.smallest_relative_square = Interval(square.lower);
  // cannot bind (result.smallest_relative_square): it spares work; frequency_condition asks the same of what
  // is proved.
  if (!certainly_positive(result.smallest_relative_square)) {
    return result;
  }
  rigor::Vector<kKklSearchVariables> worst = rigor::Vector<kKklSearchVariables>::Zero();
  result.amplitude_error_bound = bound([&](const auto& v) { return errors.amplitude(v); }, worst);
  result.frequency_error_bound = bound([&](const auto& v) { return errors.frequency(v); }, worst);
  for (int i = 0; i < kKklSearchVariables; ++i) {
    result.worst[static_cast<std::size_t>(i)] = worst(i);
  }
  return result;
}

}  // namespace

KklRobustness bound_kkl_errors(const KklRobustnessQuestion& question) {
  const rigor::UpwardRounding upward;
  const Interval settling_time(propose_settling_time(question));
  Filters transient = transient_at(question, settling_time);
  const std::array<Interval, 4> deviation = filter_deviation(question);
  for (std::size_t i = 0; i < transient.size(); ++i) {
    if (!rigor::is_finite(deviation[i])) {
      KklRobustness nothing;
      nothing.settling_time = settling_time;
      return nothing;
    }
    transient[i] += rigor::symmetric(deviation[i].upper());
  }
  KklRobustness result;
  if (const auto* bounded = std::get_if<BoundedDisturbance>(&question.disturbance)) {
    result = search_errors(BoundedErrors(question, *bounded, transient), question);
  } else {
    // No disturbance is one of amplitude 0.
    const auto* sinusoidal = std::get_if<SinusoidalDisturbance>(&question.disturbance);
    const SinusoidalDisturbance none{Interval(0.0), Interval(1.0)};
    result = search_errors(SinusoidalErrors(question, sinusoidal != nullptr ? *sinusoidal : none, transient),
                           question);
    result.worst[4] = 1.0 / result.worst[4];
  }
  result.settling_time = settling_time;
  result.knows_filters = true;
  add_rounding(question, transient, result);
  return result;
}

}  // namespace veritrack::kkl_observer
