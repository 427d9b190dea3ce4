#include "analysis/kkl_observer/kkl_tuning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/kkl_observer/kkl_settling.hpp"
#include "analysis/kkl_observer/kkl_worst_case.hpp"
#include "analysis/search/maximize.hpp"

namespace veritrack::kkl_observer {

namespace {

/// To four significant digits.
double rounded(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 3.0);
  return std::round(value / unit) * unit;
}

Eigen::Vector4d rates_of(const Eigen::VectorXd& x) {
  Eigen::Vector4d rates;
  double logarithm = 0.0;
  for (Eigen::Index i = 0; i < 4; ++i) {
    logarithm += x(i);
    rates(i) = rounded(std::exp(logarithm));
  }
  return rates;
}

}  // namespace

Eigen::Vector4d propose_rates(const KklRobustnessQuestion& question, const KklTuningLimits& limits) {
  const rigor::NearestRounding nearest;
  Eigen::Vector4d given = rigor::midpoint(question.range.lambda);
  std::sort(given.begin(), given.end());
  const double settling_time =
      limits.settling_time > 0.0 ? limits.settling_time : propose_settling_time(question);
  const auto error_of = [&](const Eigen::Vector4d& rates) {
    KklRobustnessQuestion candidate = question;
    candidate.range.lambda = rigor::to_interval(rates);
    candidate.ell = rigor::Interval(0.0);  // the proved one, for which mu vanishes
    const bool in_time = propose_settling_time(candidate) <= settling_time;
    constexpr int kPhases = 24;
    return in_time ? sample_errors(candidate, kPhases).frequency : std::numeric_limits<double>::infinity();
  };
  search::SearchSpace space;
  const double smallest_ratio = std::log(1.05);  // of neighbouring rates: closer ones are badly conditioned
  const double largest_ratio = std::log(20.0);
  space.start = Eigen::Vector4d(std::log(given(0)), std::log(given(1) / given(0)),
                                std::log(given(2) / given(1)), std::log(given(3) / given(2)));
  space.step = Eigen::Vector4d::Constant(0.3);
  space.lower =
      Eigen::Vector4d(std::log(limits.slowest_rate), smallest_ratio, smallest_ratio, smallest_ratio);
  space.upper = Eigen::Vector4d(std::log(limits.fastest_rate), largest_ratio, largest_ratio, largest_ratio);
  space.evaluations = limits.evaluations;
  const search::BestPoint best = search::maximize(
      [&](const Eigen::VectorXd& x) {
        const Eigen::Vector4d rates = rates_of(x);
        return rates(3) <= limits.fastest_rate ? -error_of(rates) : -std::numeric_limits<double>::infinity();
      },
      space);
  const Eigen::Vector4d found = rates_of(best.point);
  return error_of(found) < error_of(given) ? found : given;
}

}  // namespace veritrack::kkl_observer
