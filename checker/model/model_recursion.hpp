// A model as the checker reads it: its recursion over any scalar, and an extended Kalman filter by its
// matrices.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"
#include "checker/model/formula.hpp"
#include "checker/model/jet.hpp"

namespace veritrack::checker {

/// Formulas with their numbers and names looked up, and the constants that they need.
class ModelRecursion {
 public:
  /// From the member "model" of a design. Throws FormulaError or Malformed.
  explicit ModelRecursion(const Tree& model);

  /// Objections to it as a design, once it could be read.
  [[nodiscard]] const Objections& objections() const { return objections_; }
  [[nodiscard]] std::size_t states() const { return state_names_.size(); }
  [[nodiscard]] std::size_t samples() const { return sample_names_.size(); }
  [[nodiscard]] const std::vector<std::string>& state_names() const { return state_names_; }
  /// Whether a state is an angle.
  [[nodiscard]] const std::vector<bool>& is_angle() const { return is_angle_; }

  /// The value of a formula in parameters and numbers, exactly and as computed in doubles. Throws
  /// FormulaError.
  [[nodiscard]] Ball constant_value(const std::string& formula);

  /// The state after a sample. The state of a filter is its estimate, then the upper triangle of its
  /// covariance.
  template <typename Scalar>
  [[nodiscard]] std::vector<Scalar> next(const std::vector<Scalar>& state,
                                         const std::vector<Scalar>& sample) const {
    return filtered_ == 0 ? next_of_step(state, sample) : next_of_filter(state, sample);
  }
  /// The number of states that a filter estimates; 0 when the tracker is not a filter.
  [[nodiscard]] std::size_t filtered() const { return filtered_; }
  /// The quantities of a filter at an estimate, with a sample.
  template <typename Scalar>
  struct FilterParts {
    std::vector<Scalar> predicted;                   ///< x^ = f(x)
    std::vector<std::vector<Scalar>> jacobian;       ///< F
    std::vector<Scalar> innovation;                  ///< sample - h(x^)
    std::vector<std::vector<Scalar>> measured;       ///< H at x^
    std::vector<std::vector<Scalar>> process_noise;  ///< Q
    std::vector<std::vector<Scalar>> noise;          ///< R
  };
  template <typename Scalar>
  [[nodiscard]] FilterParts<Scalar> filter_parts(const std::vector<Scalar>& estimate,
                                                 const std::vector<Scalar>& sample) const;
  /// The estimated frequency, rad/sample.
  template <typename Scalar>
  [[nodiscard]] Scalar frequency(const std::vector<Scalar>& state) const {
    return value(frequency_, state);
  }
  /// The samples at a phase.
  template <typename Scalar>
  [[nodiscard]] std::vector<Scalar> signal(const Scalar& amplitude, const Scalar& phase) const {
    std::vector<Scalar> values;
    for (const Formula& formula : signal_) {
      values.push_back(value(formula, std::vector<Scalar>{amplitude, phase}));
    }
    return values;
  }

 private:
  using Matrix = std::vector<std::vector<Formula>>;
  /// The places of names: variable number s for a slot s of 0 or more, constant number -1 - s below.
  using Slots = std::map<std::string, int>;

  void read_parameters(const Tree& parameters);
  void read_lines_of(const std::string& text, const std::vector<std::string>& inputs,
                     const std::vector<std::string>& states, const std::vector<std::string>& angles);
  void read_filter(const Tree& filter);
  /// The formula with its numbers and names looked up; numbers become constants. Throws FormulaError.
  [[nodiscard]] Formula looked_up(Formula formula, const Slots& variables);
  [[nodiscard]] Formula looked_up_text(const Tree& text, const std::vector<std::string>& variables);
  [[nodiscard]] Matrix looked_up_matrix(const Tree& rows, std::size_t size,
                                        const std::vector<std::string>& variables);
  [[nodiscard]] static Slots numbered(const std::vector<std::string>& names);

  template <typename Scalar>
  [[nodiscard]] Scalar value(const Formula& formula, const std::vector<Scalar>& variables) const {
    return value_of<Scalar>(formula, [&](const FormulaStep& leaf) {
      return leaf.slot >= 0 ? variables[static_cast<std::size_t>(leaf.slot)]
                            : constant<Scalar>(static_cast<std::size_t>(-1 - leaf.slot));
    });
  }
  /// A scalar may ask for the place of a constant: two constants may be different although their balls are
  /// equal.
  template <typename Scalar>
  [[nodiscard]] Scalar constant(std::size_t place) const {
    if constexpr (requires { Scalar::constant(constants_[place], place); }) {
      return Scalar::constant(constants_[place], place);
    } else {
      return Scalar(constants_[place]);
    }
  }
  /// The results of the lines; unknown where a limit is not certain to be kept.
  template <typename Scalar>
  [[nodiscard]] std::vector<Scalar> results(std::vector<Scalar> variables) const {
    for (const Formula& line : lines_) {
      variables.push_back(value(line, variables));
    }
    std::vector<Scalar> next;
    for (const std::size_t slot : results_) {
      next.push_back(variables[slot]);
    }
    for (const std::size_t limit : limits_) {
      next.front() = next.front() + Scalar(Ball(0.0)) * variables[limit];
    }
    return next;
  }
  template <typename Scalar>
  [[nodiscard]] std::vector<Scalar> next_of_step(const std::vector<Scalar>& state,
                                                 const std::vector<Scalar>& sample) const {
    std::vector<Scalar> variables = state;
    variables.insert(variables.end(), sample.begin(), sample.end());
    return results(std::move(variables));
  }
  template <typename Scalar>
  [[nodiscard]] std::vector<std::vector<Scalar>> predicted_covariance(
      const std::vector<std::vector<Scalar>>& f, const std::vector<std::vector<Scalar>>& p) const;
  template <typename Scalar>
  [[nodiscard]] std::vector<Scalar> next_of_filter(const std::vector<Scalar>& state,
                                                   const std::vector<Scalar>& sample) const;

  Objections objections_;
  std::vector<std::string> sample_names_;
  std::vector<std::string> state_names_;
  std::vector<bool> is_angle_;
  Slots constant_slots_;  ///< of parameters, pi and literals
  std::vector<Ball> constants_;
  std::vector<Formula> lines_;  ///< of the step, or of the filter's prediction
  std::vector<std::size_t> results_;
  std::vector<std::size_t> limits_;  ///< lines that have to be shown, whether or not anything needs them
  Formula frequency_;
  std::vector<Formula> signal_;
  // For a filter: the number of states that it estimates (otherwise 0), and its formulas for them.
  std::size_t filtered_ = 0;
  std::vector<Formula> measure_;
  Matrix process_noise_, measurement_noise_, jacobian_;
};

// ---- how

template <typename Scalar>
ModelRecursion::FilterParts<Scalar> ModelRecursion::filter_parts(const std::vector<Scalar>& estimate,
                                                                 const std::vector<Scalar>& sample) const {
  const std::size_t n = filtered_;
  const auto jets = [&](const std::vector<Scalar>& values) {
    std::vector<Jet<Scalar>> list;
    for (std::size_t i = 0; i < n; ++i) {
      list.push_back(Jet<Scalar>::variable(values[i], i, n));
    }
    return list;
  };
  const auto values = [&](const Matrix& formulas, const std::vector<Scalar>& variables) {
    std::vector<std::vector<Scalar>> rows;
    for (const std::vector<Formula>& row : formulas) {
      rows.emplace_back();
      for (const Formula& formula : row) {
        rows.back().push_back(value(formula, variables));
      }
    }
    return rows;
  };
  FilterParts<Scalar> parts;
  const std::vector<Jet<Scalar>> predicted = results(jets(estimate));
  for (const Jet<Scalar>& each : predicted) {
    parts.predicted.push_back(each.value);
  }
  if (jacobian_.empty()) {
    for (const Jet<Scalar>& each : predicted) {
      parts.jacobian.emplace_back();
      for (std::size_t j = 0; j < n; ++j) {
        parts.jacobian.back().push_back(each.slope(j));
      }
    }
  } else {
    parts.jacobian = values(jacobian_, estimate);
  }
  for (std::size_t c = 0; c < sample.size(); ++c) {
    const Jet<Scalar> measured = value(measure_[c], jets(parts.predicted));
    parts.innovation.push_back(sample[c] - measured.value);
    parts.measured.emplace_back();
    for (std::size_t k = 0; k < n; ++k) {
      parts.measured.back().push_back(measured.slope(k));
    }
  }
  parts.process_noise = values(process_noise_, {});
  parts.noise = values(measurement_noise_, {});
  return parts;
}

/// The inverse of a matrix of one or two rows.
template <typename Scalar>
std::vector<std::vector<Scalar>> inverse_of_one_or_two(const std::vector<std::vector<Scalar>>& s) {
  if (s.size() == 1) {
    return {{Scalar(Ball(1.0)) / s[0][0]}};
  }
  const Scalar determinant = s[0][0] * s[1][1] - s[0][1] * s[1][0];
  return {{s[1][1] / determinant, -s[0][1] / determinant}, {-s[1][0] / determinant, s[0][0] / determinant}};
}

/// F P F' + Q.
template <typename Scalar>
std::vector<std::vector<Scalar>> ModelRecursion::predicted_covariance(
    const std::vector<std::vector<Scalar>>& f, const std::vector<std::vector<Scalar>>& p) const {
  const std::size_t n = f.size();
  const Scalar nothing(Ball(0.0));
  // F P first: its sums have fewer terms, and sharper bounds, than sums over all products of three.
  std::vector<std::vector<Scalar>> f_p(n, std::vector<Scalar>(n, nothing));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t l = 0; l < n; ++l) {
      for (std::size_t k = 0; k < n; ++k) {
        f_p[i][l] = f_p[i][l] + f[i][k] * p[k][l];
      }
    }
  }
  const std::vector<Scalar> none;
  std::vector<std::vector<Scalar>> predicted(n, std::vector<Scalar>(n, nothing));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j < n; ++j) {
      Scalar sum = nothing;
      for (std::size_t l = 0; l < n; ++l) {
        sum = sum + f_p[i][l] * f[j][l];
      }
      predicted[i][j] = sum + value(process_noise_[i][j], none);
      predicted[j][i] = sum + value(process_noise_[j][i], none);
    }
  }
  return predicted;
}

template <typename Scalar>
std::vector<Scalar> ModelRecursion::next_of_filter(const std::vector<Scalar>& state,
                                                   const std::vector<Scalar>& sample) const {
  using Rows = std::vector<std::vector<Scalar>>;
  const Scalar nothing(Ball(0.0));
  const std::size_t n = filtered_;
  const std::size_t channels = sample.size();
  const auto square_matrix = [&](std::size_t size) { return Rows(size, std::vector<Scalar>(size, nothing)); };
  const auto jets = [&](const std::vector<Scalar>& values) {
    std::vector<Jet<Scalar>> list;
    for (std::size_t i = 0; i < n; ++i) {
      list.push_back(Jet<Scalar>::variable(values[i], i, n));
    }
    return list;
  };
  const std::vector<Scalar> estimate(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(n));
  const std::vector<Jet<Scalar>> predicted = results(jets(estimate));
  Rows f = square_matrix(n);
  Rows p = square_matrix(n);
  std::size_t place = n;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      f[i][j] = jacobian_.empty() ? predicted[i].slope(j) : value(jacobian_[i][j], estimate);
    }
    for (std::size_t j = i; j < n; ++j) {
      p[i][j] = p[j][i] = state[place++];
    }
  }
  const std::vector<Scalar> none;
  const Rows predicted_p = predicted_covariance(f, p);
  std::vector<Scalar> predicted_estimate;
  predicted_estimate.reserve(predicted.size());
  for (const Jet<Scalar>& each : predicted) {
    predicted_estimate.push_back(each.value);
  }
  Rows cross;                                   // H P
  Rows innovation_p = square_matrix(channels);  // H P H' + R
  std::vector<Jet<Scalar>> measured;
  for (std::size_t c = 0; c < channels; ++c) {
    measured.push_back(value(measure_[c], jets(predicted_estimate)));
    cross.emplace_back(n, nothing);
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) {
        cross[c][j] = cross[c][j] + measured[c].slope(k) * predicted_p[k][j];
      }
    }
  }
  for (std::size_t c = 0; c < channels; ++c) {
    for (std::size_t d = 0; d < channels; ++d) {
      innovation_p[c][d] = value(measurement_noise_[c][d], none);
      for (std::size_t k = 0; k < n; ++k) {
        innovation_p[c][d] = innovation_p[c][d] + cross[c][k] * measured[d].slope(k);
      }
    }
  }
  const Rows inverse = inverse_of_one_or_two(innovation_p);
  Rows gain(n, std::vector<Scalar>(channels, nothing));
  std::vector<Scalar> next = predicted_estimate;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t c = 0; c < channels; ++c) {
      for (std::size_t d = 0; d < channels; ++d) {
        gain[i][c] = gain[i][c] + cross[d][i] * inverse[d][c];
      }
      next[i] = next[i] + gain[i][c] * (sample[c] - measured[c].value);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j < n; ++j) {
      Scalar entry = predicted_p[i][j];
      for (std::size_t c = 0; c < channels; ++c) {
        entry = entry - gain[i][c] * cross[c][j];
      }
      next.push_back(entry);
    }
  }
  return next;
}

}  // namespace veritrack::checker
