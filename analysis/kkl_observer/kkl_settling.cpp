#include "analysis/kkl_observer/kkl_settling.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "analysis/kkl_observer/kkl_error_map.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::kkl_observer {

namespace {

using rigor::Interval;

/// Roughly the largest |c'e| over the effects of a disturbance on the filters.
template <typename Filters>
double largest_response(const Filters& c, const Filters& lambda, const Disturbance& disturbance) {
  if (const auto* sinusoidal = std::get_if<SinusoidalDisturbance>(&disturbance)) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      sum += c[i] / std::complex<double>(lambda[i], rigor::midpoint(sinusoidal->frequency));
    }
    return rigor::midpoint(sinusoidal->amplitude) * std::abs(sum);
  }
  const auto* bounded = std::get_if<BoundedDisturbance>(&disturbance);
  if (bounded == nullptr) {
    return 0.0;
  }
  const double slowest = *std::min_element(lambda.begin(), lambda.end());
  constexpr int kSteps = 400;
  const double step = 12.0 / slowest / kSteps;
  double integral = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    double kernel = 0.0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      kernel += c[i] * std::exp(-lambda[i] * (k + 0.5) * step);
    }
    integral += std::fabs(kernel) * step;
  }
  return rigor::midpoint(bounded->bound) * integral;
}

}  // namespace

template <int M>
KklFilters<M> transient_at(const KklRobustnessQuestionOf<M>& question, const Interval& time) {
  KklFilters<M> transient;
  const auto gain = [](const Interval& rate, const Interval& frequency) {
    return Interval(1.0) / sqrt(square(rate) + square(frequency));
  };
  for (std::size_t i = 0; i < transient.size(); ++i) {
    const Interval rate = question.range.lambda(static_cast<Eigen::Index>(i));
    Interval start = gain(rate, question.range.frequency);
    if (const auto* sinusoidal = std::get_if<SinusoidalDisturbance>(&question.disturbance)) {
      start += sinusoidal->amplitude * gain(rate, sinusoidal->frequency) / question.amplitude;
    }
    transient[i] = rigor::symmetric((exp(-(rate * time)) * start).upper());
  }
  return transient;
}

template <int M>
double propose_settling_time(const KklRobustnessQuestionOf<M>& question) {
  using Map = KklErrorMap<double, M>;
  const rigor::NearestRounding nearest;
  constexpr double kShare = 0.003;      // of the disturbance's effect
  constexpr double kWithoutOne = 1e-3;  // of the lowest frequency
  const Eigen::Matrix<double, M, 1> rates = rigor::midpoint(question.range.lambda);
  const Map map(rates);
  const double low = question.range.frequency.lower();
  const double high = question.range.frequency.upper();
  const double amplitude = question.amplitude.lower();
  constexpr int kFrequencies = 9;
  constexpr int kPhases = 24;
  struct Direction {
    typename Map::template Filters<double> coefficients;
    double frequency;
  };
  std::vector<Direction> directions;
  directions.reserve(kFrequencies * kPhases);
  double effect = 0.0;
  for (int k = 0; k < kFrequencies; ++k) {
    const double frequency = low * std::pow(high / low, k / (kFrequencies - 1.0));
    for (int j = 0; j < kPhases; ++j) {
      const auto at = map.signal(frequency, std::numbers::pi * j / kPhases);
      Direction direction{map.pulling(at), frequency};
      for (double& coefficient : direction.coefficients) {
        coefficient = coefficient / Map::squared_norm(at.projected) / (2.0 * frequency);
      }
      effect = std::max(
          effect, largest_response(direction.coefficients, map.lambda(), question.disturbance) / amplitude);
      directions.push_back(direction);
    }
  }
  const double allowed = effect > 0.0 ? kShare * effect : kWithoutOne * low;
  const auto left_after = [&](double time) {
    double largest = 0.0;
    for (const Direction& direction : directions) {
      double sum = 0.0;
      for (std::size_t i = 0; i < direction.coefficients.size(); ++i) {
        sum += std::fabs(direction.coefficients[i]) * std::exp(-map.lambda()[i] * time) /
               std::hypot(map.lambda()[i], low);
      }
      largest = std::max(largest, sum);
    }
    return largest;
  };
  double early = 0.0;
  double late = 60.0 / rates.minCoeff();
  for (int step = 0; step < 50; ++step) {
    const double middle = 0.5 * (early + late);
    (left_after(middle) > allowed ? early : late) = middle;
  }
  return late;
}

template KklFilters<4> transient_at<4>(const KklRobustnessQuestionOf<4>&, const Interval&);
template KklFilters<5> transient_at<5>(const KklRobustnessQuestionOf<5>&, const Interval&);
template KklFilters<6> transient_at<6>(const KklRobustnessQuestionOf<6>&, const Interval&);
template KklFilters<7> transient_at<7>(const KklRobustnessQuestionOf<7>&, const Interval&);
template KklFilters<8> transient_at<8>(const KklRobustnessQuestionOf<8>&, const Interval&);
template double propose_settling_time<4>(const KklRobustnessQuestionOf<4>&);
template double propose_settling_time<5>(const KklRobustnessQuestionOf<5>&);
template double propose_settling_time<6>(const KklRobustnessQuestionOf<6>&);
template double propose_settling_time<7>(const KklRobustnessQuestionOf<7>&);
template double propose_settling_time<8>(const KklRobustnessQuestionOf<8>&);

}  // namespace veritrack::kkl_observer
