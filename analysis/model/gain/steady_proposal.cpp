#include "analysis/model/gain/steady_proposal.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/small_matrix.hpp"

namespace veritrack::model {

namespace {

/// The form as far as it is known before: turns, and the parts of a vector.
std::vector<SteadyValue> form_of_steady_state(const TrackerModel& tracker,
                                              const std::optional<ProposedVector>& vector) {
  std::vector<SteadyValue> steady;
  for (const bool is_angle : tracker.recursion->is_angle) {
    steady.push_back({is_angle ? 1 : 0, 0.0, 0.0});
  }
  if (vector) {
    steady[vector->real].turns = vector->turns;
    steady[vector->real].imaginary = vector->imaginary;
    steady[vector->imaginary].constant = vector->has_length ? 1.0 : 0.0;
  }
  return steady;
}

bool is_direction(const TrackerModel& tracker, const std::vector<SteadyValue>& steady, std::size_t i) {
  return tracker.recursion->is_angle[i] || steady[i].imaginary;
}

/// The steady state at one frequency, if Newton's method finds one: by the residual of the network.
std::optional<Eigen::VectorXd> steady_at(const TrackerModel& tracker, std::vector<SteadyValue> steady,
                                         double omega, const std::vector<double>& start) {
  constexpr int kSteps = 50;
  const auto n = static_cast<Eigen::Index>(start.size());
  Eigen::VectorXd state = Eigen::Map<const Eigen::VectorXd>(start.data(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (const auto& imaginary = steady[static_cast<std::size_t>(i)].imaginary) {
      const auto other = static_cast<Eigen::Index>(*imaginary);
      const double length = std::hypot(state(i), state(other));
      const bool has_length = model::has_length(steady[static_cast<std::size_t>(i)], steady);
      state(i) = std::atan2(state(other), state(i));
      state(other) = has_length ? length : 0.0;
    }
  }
  double last = INFINITY;
  for (int step = 0; step < kSteps; ++step) {
    for (Eigen::Index i = 0; i < n; ++i) {
      steady[static_cast<std::size_t>(i)].constant = state(i);
    }
    const StepResidual residual = step_residual(tracker, steady, omega);
    const Eigen::VectorXd change =
        rigor::product(rigor::approximate_inverse(residual.slope - rigor::identity(n)), residual.value);
    if (!change.allFinite()) {
      return std::nullopt;
    }
    double size = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      state(i) -= change(i);
      // The increment of the state in a step is rounded, however small the state is in its unit.
      double scale = std::max(std::fabs(state(i)), 1e-6);
      for (Eigen::Index j = 0; j < n; ++j) {
        const bool is_angle = is_direction(tracker, steady, static_cast<std::size_t>(j));
        const double natural = is_angle ? 1.0 : std::fabs(state(j));
        scale = std::max(scale, j == i ? 0.0 : std::fabs(residual.slope(i, j)) * natural);
      }
      size = std::max(size, std::fabs(change(i)) / scale);
    }
    // As near as rounding lets it come.
    if (size < 1e-14 || (size < 1e-6 && size >= 0.5 * last)) {
      return state;
    }
    last = size;
  }
  return std::nullopt;
}

/// A function of the frequency with these two values.
SteadyValue line_through(SteadyValue form, double low, double first, double high, double second,
                         bool is_angle) {
  double change = second - first;
  if (is_angle) {
    change = std::remainder(change, 2.0 * rigor::midpoint(rigor::pi()));
  }
  const double size = std::max(std::fabs(first), std::fabs(second));
  double slope = high > low && std::fabs(change) > 1e-11 * size ? change / (high - low) : 0.0;
  // A whole number is most often meant where it is nearly one.
  const double whole = std::round(slope);
  slope = std::fabs(slope - whole) < 1e-9 * std::max(1.0, std::fabs(slope)) ? whole : slope;
  double constant = first - slope * low;
  if (is_angle) {
    constant = std::remainder(constant, 2.0 * rigor::midpoint(rigor::pi()));
  }
  const bool is_rounding =
      std::fabs(constant) < 1e-11 * std::max(size, std::fabs(slope * low)) || std::fabs(constant) < 1e-13;
  form.constant = is_rounding ? 0.0 : constant;
  form.per_frequency = slope;
  return form;
}

Eigen::VectorXd state_with(const std::vector<SteadyValue>& steady, const Eigen::VectorXd& lengths,
                           double phase, double omega) {
  Eigen::VectorXd state(static_cast<Eigen::Index>(steady.size()));
  for (std::size_t i = 0; i < steady.size(); ++i) {
    state(static_cast<Eigen::Index>(i)) =
        steady[i].turns * phase + steady[i].constant + steady[i].per_frequency * omega;
  }
  for (std::size_t i = 0; i < steady.size(); ++i) {
    if (steady[i].imaginary) {
      const auto place = static_cast<Eigen::Index>(i);
      const auto other = static_cast<Eigen::Index>(*steady[i].imaginary);
      const double angle = state(place);
      const double length = has_length(steady[i], steady) ? state(other) : lengths(place);
      state(place) = length * std::cos(angle);
      state(other) = length * std::sin(angle);
    }
  }
  return state;
}

/// The lengths of vectors, by the place of the real part.
Eigen::VectorXd lengths_of(const TrackedTone& tone, const std::vector<SteadyValue>& steady, double omega) {
  Eigen::VectorXd lengths =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(steady.size()), tone.amplitude);
  if (!vector_of(steady)) {
    return lengths;
  }
  const Eigen::VectorXd next = tone.step.next(state_with(steady, lengths, -omega, omega),
                                              samples_of(tone.signal, tone.amplitude, 0.0));
  for (std::size_t i = 0; i < steady.size(); ++i) {
    if (steady[i].imaginary) {
      const auto place = static_cast<Eigen::Index>(i);
      lengths(place) = std::hypot(next(place), next(static_cast<Eigen::Index>(*steady[i].imaginary)));
    }
  }
  return lengths;
}

}  // namespace

std::vector<ProposedVector> possible_vectors(const TrackerModel& tracker) {
  std::vector<ProposedVector> vectors;
  const std::vector<bool>& is_angle = tracker.recursion->is_angle;
  for (std::size_t i = 0; tracker.recursion->samples == 2 && i < is_angle.size(); ++i) {
    for (std::size_t j = 0; j < is_angle.size(); ++j) {
      if (i != j && !is_angle[i] && !is_angle[j]) {
        // A copy of the samples, and one that is turned back by an angle of the loop.
        vectors.push_back({i, j, 1});
        vectors.push_back({i, j, 0});
      }
    }
  }
  const std::size_t count = vectors.size();
  for (std::size_t k = 0; k < count; ++k) {
    vectors.push_back(vectors[k]);
    vectors.back().has_length = true;
  }
  return vectors;
}

std::optional<ProposedVector> vector_of(const std::vector<SteadyValue>& steady) {
  for (std::size_t i = 0; i < steady.size(); ++i) {
    if (steady[i].imaginary) {
      return ProposedVector{i, *steady[i].imaginary, steady[i].turns, has_length(steady[i], steady)};
    }
  }
  return std::nullopt;
}

std::optional<std::vector<SteadyValue>> proposed_steady_state(const TrackerModel& tracker,
                                                              const StartState& start, double low,
                                                              double high,
                                                              const std::optional<ProposedVector>& vector) {
  std::vector<SteadyValue> steady = form_of_steady_state(tracker, vector);
  const auto first = steady_at(tracker, steady, low, start(low));
  const auto second = steady_at(tracker, steady, high, start(high));
  if (!first || !second) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < steady.size(); ++i) {
    const auto place = static_cast<Eigen::Index>(i);
    steady[i] = line_through(steady[i], low, (*first)(place), high, (*second)(place),
                             is_direction(tracker, steady, i));
  }
  return steady;
}

Eigen::VectorXd state_at(const TrackedTone& tone, const std::vector<SteadyValue>& steady, double phase,
                         double omega) {
  return state_with(steady, lengths_of(tone, steady, omega), phase, omega);
}

Eigen::VectorXd state_per_frequency(const TrackedTone& tone, const std::vector<SteadyValue>& steady,
                                    double phase, double omega) {
  const Eigen::VectorXd state = state_at(tone, steady, phase, omega);
  Eigen::VectorXd change(state.size());
  for (std::size_t i = 0; i < steady.size(); ++i) {
    change(static_cast<Eigen::Index>(i)) = steady[i].per_frequency;
  }
  for (std::size_t i = 0; i < steady.size(); ++i) {
    if (steady[i].imaginary) {
      const auto real = static_cast<Eigen::Index>(i);
      const auto imaginary = static_cast<Eigen::Index>(*steady[i].imaginary);
      const double rate = change(real);
      // The length grows by this share of it.
      const double growth =
          has_length(steady[i], steady) ? change(imaginary) / std::hypot(state(real), state(imaginary)) : 0.0;
      change(real) = growth * state(real) - rate * state(imaginary);
      change(imaginary) = growth * state(imaginary) + rate * state(real);
    }
  }
  return change;
}

}  // namespace veritrack::model
