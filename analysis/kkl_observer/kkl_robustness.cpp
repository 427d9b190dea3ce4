#include "analysis/kkl_observer/kkl_robustness.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "analysis/kkl_observer/kkl_bounded_errors.hpp"
#include "analysis/kkl_observer/kkl_settling.hpp"
#include "analysis/kkl_observer/kkl_sinusoidal_errors.hpp"
#include "analysis/kkl_observer/kkl_split_errors.hpp"
#include "analysis/kkl_observer/rounding/estimate_rounding.hpp"
#include "analysis/kkl_observer/rounding/filter_deviation.hpp"
#include "analysis/search/branch_and_bound.hpp"

namespace veritrack::kkl_observer {

namespace {

using rigor::Interval;
template <typename Errors, typename Question>
KklRobustness search_errors(const Errors& errors, const Question& question) {
  constexpr int kVariables = std::remove_cvref_t<decltype(errors.box())>::RowsAtCompileTime;
  KklRobustness result;
  const auto minimize = [&](double tolerance, double sufficient, const auto& function) {
    search::BranchAndBoundSettings<kVariables> settings;
    settings.relative_tolerance = tolerance;
    settings.sufficient = sufficient;
    settings.cells = question.cells;
    settings.batch = 256;
    settings.importance = errors.importance();
    settings.of_lower_ends = true;  // the remaining effect of the start lies anywhere in its intervals
    auto minimum = search::minimize_globally<kVariables>(function, errors.box(), settings);
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
  // cannot bind (result.smallest_relative_square): it saves work; frequency_condition requires the same of
  // the proved number.
  if (!certainly_positive(result.smallest_relative_square)) {
    return result;
  }
  rigor::Vector<kVariables> worst = rigor::Vector<kVariables>::Zero();
  result.amplitude_error_bound = bound([&](const auto& v) { return errors.amplitude(v); }, worst);
  result.frequency_error_bound = bound([&](const auto& v) { return errors.frequency(v); }, worst);
  for (int i = 0; i < kVariables; ++i) {
    result.worst[static_cast<std::size_t>(i)] = worst(i);
  }
  return result;
}

/// With `search`, which bounds the errors of filters that deviate by this much after settling.
template <int M, typename Search>
KklRobustness bound_errors(const KklRobustnessQuestionOf<M>& question, const Search& search) {
  const rigor::UpwardRounding upward;
  const Interval settling_time(propose_settling_time(question));
  KklFilters<M> transient = transient_at(question, settling_time);
  const KklFilters<M> deviation = filter_deviation(question);
  for (std::size_t i = 0; i < transient.size(); ++i) {
    if (!rigor::is_finite(deviation[i])) {
      KklRobustness nothing;
      nothing.settling_time = settling_time;
      return nothing;
    }
    transient[i] += rigor::symmetric(deviation[i].upper());
  }
  KklRobustness result = search(transient);
  result.settling_time = settling_time;
  result.knows_filters = true;
  add_rounding<M>(question, transient, result);
  return result;
}

/// Over signal and disturbance.
KklRobustness search_disturbances(const KklRobustnessQuestion& question, const KklFilters<4>& transient) {
  if (const auto* bounded = std::get_if<BoundedDisturbance>(&question.disturbance)) {
    return search_errors(BoundedErrors(question, *bounded, transient), question);
  }
  // No disturbance is one of amplitude 0.
  const auto* sinusoidal = std::get_if<SinusoidalDisturbance>(&question.disturbance);
  const SinusoidalDisturbance none{Interval(0.0), Interval(1.0)};
  KklRobustness result = search_errors(
      SinusoidalErrors(question, sinusoidal != nullptr ? *sinusoidal : none, transient), question);
  result.worst[4] = 1.0 / result.worst[4];
  return result;
}

}  // namespace

template <int M>
KklRobustness bound_kkl_errors_over_signals(const KklRobustnessQuestionOf<M>& question) {
  constexpr double kTolerance = 0.03;  // two variables are soon divided
  KklRobustnessQuestionOf<M> closer = question;
  closer.relative_tolerance = std::min(question.relative_tolerance, kTolerance);
  return bound_errors<M>(question, [&](const KklFilters<M>& transient) {
    return search_errors(SplitErrors<M>(question, transient), closer);
  });
}

template <int M>
KklRobustness bound_kkl_errors(const KklRobustnessQuestionOf<M>& question) {
  if constexpr (M == 4) {
    return bound_errors<M>(
        question, [&](const KklFilters<M>& transient) { return search_disturbances(question, transient); });
  } else {
    return bound_kkl_errors_over_signals<M>(question);
  }
}

template KklRobustness bound_kkl_errors_over_signals<4>(const KklRobustnessQuestionOf<4>&);
template KklRobustness bound_kkl_errors_over_signals<5>(const KklRobustnessQuestionOf<5>&);
template KklRobustness bound_kkl_errors_over_signals<6>(const KklRobustnessQuestionOf<6>&);
template KklRobustness bound_kkl_errors_over_signals<7>(const KklRobustnessQuestionOf<7>&);
template KklRobustness bound_kkl_errors_over_signals<8>(const KklRobustnessQuestionOf<8>&);
template KklRobustness bound_kkl_errors<4>(const KklRobustnessQuestionOf<4>&);
template KklRobustness bound_kkl_errors<5>(const KklRobustnessQuestionOf<5>&);
template KklRobustness bound_kkl_errors<6>(const KklRobustnessQuestionOf<6>&);
template KklRobustness bound_kkl_errors<7>(const KklRobustnessQuestionOf<7>&);
template KklRobustness bound_kkl_errors<8>(const KklRobustnessQuestionOf<8>&);

}  // namespace veritrack::kkl_observer
