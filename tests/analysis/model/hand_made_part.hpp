// Parts of a loop's frequencies that are made by hand: functions on a grid that are what they say, and
// matrices within their bounds.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "analysis/model/gain/phase_kernels.hpp"
#include "tests/support/random.hpp"

namespace veritrack::test {

/// What a grid function is at most, by its definition, from its values and errors.
inline model::GridFunction completed(model::GridFunction f) {
  const std::size_t components = f.values[0].size();
  for (auto* each : {&f.largest, &f.first_difference, &f.second_difference, &f.lean, &f.lean_difference}) {
    each->assign(components, 0.0);
  }
  for (std::size_t i = 0; i < components; ++i) {
    const std::size_t count = f.values[0][i].size();
    const auto half = [&](std::size_t g) {
      return 0.5 * (f.values[1][i][g % count] - f.values[0][i][g % count]);
    };
    for (std::size_t g = 0; g < count; ++g) {
      for (const auto& end : f.values) {
        const double now = end[i][g];
        const double next = end[i][(g + 1) % count];
        const double last = end[i][(g + 2) % count];
        f.largest[i] = std::max(f.largest[i], std::fabs(now));
        f.first_difference[i] = std::max(f.first_difference[i], std::fabs(next - now));
        f.second_difference[i] = std::max(f.second_difference[i], std::fabs(last - 2.0 * next + now));
      }
      f.lean[i] = std::max(f.lean[i], std::fabs(half(g)));
      f.lean_difference[i] = std::max(f.lean_difference[i], std::fabs(half(g + 1) - half(g)));
    }
  }
  return f;
}

/// Two waves and a constant of random size and phase, a little different at the other end of the part.
inline model::GridFunction random_function(Random& random, std::size_t phases, double lean, double error) {
  model::GridFunction f;
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<double> at_end[2] = {std::vector<double>(phases), std::vector<double>(phases)};
    for (int h = 0; h < 3; ++h) {
      const double size = random.uniform(-1.0, 1.0);
      const double begin = random.uniform(0.0, 6.3);
      const double more = lean * random.uniform(-1.0, 1.0);
      const double later = begin + lean * random.uniform(-1.0, 1.0);
      for (std::size_t g = 0; g < phases; ++g) {
        const double phase =
            h * 2.0 * std::numbers::pi * static_cast<double>(g) / static_cast<double>(phases);
        at_end[0][g] += size * std::cos(phase + begin);
        at_end[1][g] += (size + more) * std::cos(phase + later);
      }
    }
    f.values[0].push_back(at_end[0]);
    f.values[1].push_back(at_end[1]);
  }
  f.error.assign(2, error);
  return completed(std::move(f));
}

/// A function within its error of the grid's: at a phase, rad, and t in [-1, 1]. The error is that which a
/// row sees most of.
inline Eigen::Vector2d grid_value(const model::GridFunction& f, double phase, double t,
                                  const Eigen::RowVector2d& row) {
  Eigen::Vector2d result;
  for (const Eigen::Index i : {0, 1}) {
    const auto component = static_cast<std::size_t>(i);
    const auto count = static_cast<double>(f.values[0][component].size());
    const double turns = phase / (2.0 * std::numbers::pi);
    const double place = (turns - std::floor(turns)) * count;
    const auto g = std::min(static_cast<std::size_t>(place), f.values[0][component].size() - 1);
    const double share = place - static_cast<double>(g);
    double value = 0.0;
    for (const std::size_t end : {0U, 1U}) {
      const std::vector<double>& of = f.values[end][component];
      value += 0.5 * (end == 0 ? 1.0 - t : 1.0 + t) * (of[g] + share * (of[(g + 1) % of.size()] - of[g]));
    }
    result(i) = value;
  }
  const double sign = std::copysign(1.0, row.dot(result));
  for (const Eigen::Index i : {0, 1}) {
    result(i) += std::copysign(f.error[static_cast<std::size_t>(i)], sign * row(i));
  }
  return result;
}

struct HandMade {
  std::size_t phases = 256;
  double frequency = 0.5, half_width = 1e-6;
  double decay = 0.9;    ///< the size of both eigenvalues of the matrix, nearly
  double turning = 0.3;  ///< their angle, rad, at most
  double lean = 0.0, error = 0.0;
  double off = 0.0, residual = 0.0;
  std::size_t channels = 1;
};

/// Two states, two forms, two gates (inputs 3 and 5) and a slew.
inline model::PhasePart hand_made_part(Random& random, const HandMade& of) {
  model::PhasePart part;
  part.states = 2;
  part.frequency = of.frequency;
  part.half_width = of.half_width;
  const auto function = [&] { return random_function(random, of.phases, of.lean, of.error); };
  for (std::size_t f = 0; f < 2; ++f) {
    part.forms.push_back(function());
  }
  for (std::size_t c = 0; c < of.channels; ++c) {
    part.noise.push_back(function());
  }
  part.columns.emplace(3, function());
  part.columns.emplace(5, function());
  part.slew = function();
  const double angle = random.uniform(0.0, of.turning);
  part.middle = {of.decay * std::cos(angle), -of.decay * std::sin(angle), of.decay * std::sin(angle),
                 of.decay * std::cos(angle)};
  for (const double each : part.middle) {
    part.lean.push_back(of.lean * (1.0 - of.decay) * random.uniform(-1.0, 1.0));
    part.off.push_back(of.off * (1.0 - of.decay));
    const double far = std::fabs(part.lean.back()) + part.off.back();
    part.matrix.push_back(rigor::Interval::from_bounds(each - far, each + far));
  }
  part.residual = {of.residual, of.residual};
  return part;
}

/// The row times a matrix of the part at t: one that makes it long.
inline Eigen::RowVector2d times_matrix(const Eigen::RowVector2d& row, const model::PhasePart& part,
                                       double t) {
  Eigen::RowVector2d result;
  for (const Eigen::Index j : {0, 1}) {
    double sum = 0.0;
    double more = 0.0;
    for (const Eigen::Index i : {0, 1}) {
      const auto entry = static_cast<std::size_t>(2 * i + j);
      sum += row(i) * (part.middle[entry] + t * part.lean[entry]);
      more += std::fabs(row(i)) * part.off[entry];
    }
    result(j) = sum + std::copysign(more, sum);
  }
  return result;
}

}  // namespace veritrack::test
