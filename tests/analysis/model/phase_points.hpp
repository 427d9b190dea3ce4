// Values and steps over cells of phases at points of the cells, in floating point.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "analysis/model/gain/phase_rules.hpp"
#include "analysis/model/gain/phase_step.hpp"
#include "tests/support/random.hpp"

namespace veritrack::test {

/// A model of the place alone, at a place: its polynomial, by its definition.
inline double polynomial_at(const rigor::BallModel& f, double s, double z) {
  double sum = 0.0;
  for (const rigor::BallMonomials::Class& each : f.monomials().classes()) {
    sum += f.coefficients()[each.first] * std::pow(s, each.s) * std::pow(z, each.z);
  }
  return sum;
}

/// A place in a cell, errors of the states there, and the noise.
struct PhasePoint {
  double s = 0.0, z = 0.0;
  std::vector<double> states;
  std::vector<double> noise;
};

/// Of a step's inputs at a point: forms are bounded by what they are there, and no more.
inline std::vector<double> sizes_at(const model::PhaseStep& step, const PhasePoint& point) {
  std::vector<double> of_states;
  for (const model::PhaseForm& form : step.forms) {
    double sum = 0.0;
    double more = 0.0;
    for (std::size_t j = 0; j < form.states.size(); ++j) {
      sum += polynomial_at(form.states[j], point.s, point.z) * point.states[j];
      more += form.states[j].error() * std::fabs(point.states[j]);
    }
    of_states.push_back(std::fabs(sum) + more);
  }
  std::vector<double> sizes(step.inputs.size(), 0.0);
  const auto sum_of = [&](const std::vector<model::DirectWeight>& weights) {
    double sum = 0.0;
    for (const model::DirectWeight& each : weights) {
      sum += each.weight * sizes[static_cast<std::size_t>(each.input)];
    }
    return sum;
  };
  // A form depends on earlier inputs, and an input on earlier forms: each round settles one more.
  for (std::size_t round = 0; round <= step.inputs.size(); ++round) {
    std::vector<double> bounds = of_states;
    for (std::size_t f = 0; f < bounds.size(); ++f) {
      bounds[f] += sum_of(step.forms[f].direct);
    }
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const model::PhaseInput& input = step.inputs[i];
      sizes[i] = input.is_noise ? std::fabs(point.noise[i])
                 : input.size   ? input.size(bounds)
                                : sum_of(input.sources);
    }
  }
  return sizes;
}

/// How far a value is from its line at a point, and how far it may be.
struct Miss {
  double far = 0.0, room = 0.0;
};
inline Miss miss_of(const model::PhaseValue& value, const std::vector<double>& sizes, const PhasePoint& point,
                    double truth) {
  const std::size_t states = point.states.size();
  double line = polynomial_at(value.base, point.s, point.z);
  double room = value.base.error();
  for (const auto& [key, slope] : value.slopes) {
    const auto place = static_cast<std::size_t>(key);
    const double factor = polynomial_at(slope, point.s, point.z);
    if (place < states + point.noise.size()) {
      const double error = place < states ? point.states[place] : point.noise[place - states];
      line += factor * error;
      room += slope.error() * std::fabs(error);
    } else {
      room += (std::fabs(factor) + slope.error()) * sizes[place - states];
    }
  }
  return {std::fabs(truth - line), room};
}

/// c0 + c1 s + c2 z.
struct PlainLine {
  double constant = 0.0, by_s = 0.0, by_z = 0.0;

  [[nodiscard]] double at(const PhasePoint& point) const {
    return constant + by_s * point.s + by_z * point.z;
  }
  [[nodiscard]] rigor::BallModel model() const {
    rigor::BallModel result(constant);
    result.add_multiple(rigor::BallModel::s(), by_s);
    result.add_multiple(rigor::BallModel::z(), by_z);
    return result;
  }
};

inline constexpr std::size_t kPlainErrors = 2;  // of states; a component of noise comes after them

/// A value with a base, and slopes by both errors and the noise.
struct PlainValue {
  PlainLine base;
  std::vector<PlainLine> slopes;

  [[nodiscard]] double deviation(const PhasePoint& point) const {
    double sum = 0.0;
    for (std::size_t j = 0; j < slopes.size(); ++j) {
      sum += slopes[j].at(point) * (j < kPlainErrors ? point.states[j] : point.noise[0]);
    }
    return sum;
  }
  [[nodiscard]] double at(const PhasePoint& point) const { return base.at(point) + deviation(point); }
  [[nodiscard]] model::PhaseValue model() const {
    model::PhaseValue result{base.model(), {}};
    for (std::size_t j = 0; j < slopes.size(); ++j) {
      result.slopes.emplace(static_cast<int>(j), slopes[j].model());
    }
    return result;
  }
};

/// Of a step whose only input yet is a component of noise.
inline model::PhaseStep step_with_noise() {
  model::PhaseStep step;
  step.inputs.push_back({true, {}, {}});
  return step;
}

/// Its base in the middle of the cell is between low and high.
inline PlainValue random_value(Random& random, double low, double high, double deviation, double width) {
  PlainValue value{
      {random.uniform(low, high), width * random.uniform(-1.0, 1.0), width * random.uniform(-1.0, 1.0)}, {}};
  for (std::size_t j = 0; j <= kPlainErrors; ++j) {
    const double slope = deviation * random.uniform(-0.3, 0.3);
    value.slopes.push_back({slope, 0.1 * slope * random.uniform(), 0.0});
  }
  return value;
}

inline PhasePoint random_point(Random& random) {
  const auto any = [&random] { return random.uniform(-1.0, 1.0); };
  PhasePoint point{any(), any(), {}, {}};
  point.states = {any(), any()};
  point.noise = {any()};
  return point;
}

}  // namespace veritrack::test
