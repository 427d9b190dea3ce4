#include "checker/model/gain/gain_ripples.hpp"

#include <acb_mat.h>

#include <algorithm>
#include <utility>

namespace veritrack::checker {

namespace {

constexpr long kBandParts = 1024;

/// A matrix of complex balls.
class ComplexMatrix {
 public:
  ComplexMatrix(std::size_t rows, std::size_t columns) {
    acb_mat_init(entries_, static_cast<slong>(rows), static_cast<slong>(columns));
  }
  ComplexMatrix(const ComplexMatrix&) = delete;
  ComplexMatrix& operator=(const ComplexMatrix&) = delete;
  ~ComplexMatrix() { acb_mat_clear(entries_); }

  [[nodiscard]] acb_ptr at(std::size_t row, std::size_t column) {
    return acb_mat_entry(entries_, static_cast<slong>(row), static_cast<slong>(column));
  }
  void set(std::size_t row, std::size_t column, const Ball& real, const Ball& imaginary) {
    acb_set_arb_arb(at(row, column), real.raw(), imaginary.raw());
  }
  /// *this = a^-1 b. Throws NotCovered where a may be singular.
  void solve(ComplexMatrix& a, ComplexMatrix& b) {
    const slong n = acb_mat_nrows(a.entries_);
    spend(10 * n * n * n);
    if (acb_mat_solve_precond(entries_, a.entries_, b.entries_, precision()) == 0) {
      throw NotCovered("the response to a ripple is not certain");
    }
  }

 private:
  acb_mat_t entries_;
};

/// |sum of row_i x_i|, from above.
Ball length_of_product(const std::vector<Ball>& row, ComplexMatrix& x) {
  acb_t sum;
  acb_init(sum);
  for (std::size_t i = 0; i < row.size(); ++i) {
    spend(4);
    acb_addmul_arb(sum, x.at(i, 0), row[i].raw(), precision());
  }
  Ball result;
  acb_abs(result.raw(), sum, precision());
  acb_clear(sum);
  return result.upper();
}

/// The largest over the band, where (e - A) Pi = g e with e = e^(jt omega), and Pi = kappa g + rho.
struct Responses {
  std::vector<Ball> of_row;  ///< |row Pi|
  std::vector<Ball> rest;    ///< |rho_j|
  Ball direct;               ///< |kappa|
};

/// A - I, row by row: rho = (A - I) Pi/(e - 1), kappa = e/(e - 1).
std::vector<std::vector<Ball>> less_identity(std::vector<std::vector<Ball>> matrix) {
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    matrix[i][i] = matrix[i][i] - one;
  }
  return matrix;
}

Responses largest_responses(const GainNetwork& network, const GainRipple& ripple,
                            const std::vector<std::vector<Ball>>& rows, const Ball& lowest,
                            const Ball& highest) {
  const std::size_t n = network.states();
  const Ball turns(static_cast<double>(ripple.turns));
  const std::vector<InputFactor>& column = network.inputs[ripple.input].column;
  const std::vector<std::vector<Ball>> changes = less_identity(network.matrix);
  Responses largest{std::vector<Ball>(rows.size()), std::vector<Ball>(n), zero};
  const auto border = [&](long part) {
    return lowest + (highest - lowest) * Ball(static_cast<double>(part)) / Ball(double{kBandParts});
  };
  const auto raise = [](Ball& most, const Ball& size) {
    most = max(most, size);
    if (!most.finite()) {
      throw NotCovered("the response to a ripple is not known");
    }
  };
  for (long part = 0; part < kBandParts; ++part) {
    const Ball angle = turns * Ball::hull(border(part), border(part + 1));
    const Ball real = cos(angle);
    const Ball imaginary = sin(angle);
    ComplexMatrix matrix(n, n);
    ComplexMatrix right(n, 1);
    ComplexMatrix response(n, 1);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        matrix.set(i, j, i == j ? real - network.matrix[i][j] : -network.matrix[i][j],
                   i == j ? imaginary : zero);
      }
      // (b_1 - j b_2) e^(jt omega)
      const InputFactor& b = column[i];
      right.set(i, 0, b.first * real + b.second * imaginary, b.first * imaginary - b.second * real);
    }
    response.solve(matrix, right);
    const Ball direct = one / sqrt(square(real - one) + square(imaginary));  // |e| = 1
    raise(largest.direct, direct.upper());
    for (std::size_t row = 0; row < rows.size(); ++row) {
      raise(largest.of_row[row], length_of_product(rows[row], response));
    }
    for (std::size_t i = 0; i < n; ++i) {
      raise(largest.rest[i], (length_of_product(changes[i], response) * direct).upper());
    }
  }
  return largest;
}

/// The form of how much the angle of a ripple changes at a sample.
GainForm change_of(const GainNetwork& network, const std::vector<Ball>& angle) {
  const std::size_t n = network.states();
  GainForm form;
  form.row.assign(n, zero);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      form.row[j] += angle[i] * (i == j ? network.matrix[i][j] - one : network.matrix[i][j]);
    }
  }
  for (std::size_t input = 0; input < network.inputs.size(); ++input) {
    InputFactor factor{zero, zero};
    for (std::size_t i = 0; i < n; ++i) {
      factor.first += angle[i] * network.inputs[input].column[i].first;
      factor.second += angle[i] * network.inputs[input].column[i].second;
    }
    if (!certainly_equal(factor.first, zero) || !certainly_equal(factor.second, zero)) {
      form.direct[input] = factor;
    }
  }
  return form;
}

/// The effect of changes of its angle in the direction of a ripple.
GainInput direct_drift_of(const GainNetwork& network, const GainRipple& ripple) {
  GainInput drift;
  drift.column = network.inputs[ripple.input].column;
  drift.about = {ripple.change_form};
  drift.at_bounds = [size = ripple.direct](const std::vector<Ball>& bounds) {
    return size * min(two, bounds.at(0));
  };
  return drift;
}

/// The other effects of changes of the angles of ripples on this state.
GainInput drift_of(const GainNetwork& network, std::size_t state) {
  GainInput drift;
  drift.column.assign(network.states(), {zero, zero});
  drift.column[state].first = one;
  std::vector<Ball> sizes;
  for (const GainRipple& ripple : network.ripples) {
    drift.about.push_back(ripple.change_form);
    sizes.push_back(ripple.rest_of_state[state]);
  }
  drift.at_bounds = [sizes](const std::vector<Ball>& bounds) {
    Ball sum;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      sum += sizes[i] * min(two, bounds.at(i));
    }
    return sum;
  };
  return drift;
}

}  // namespace

void add_ripples(const std::vector<FrameInput>& inputs, const Ball& lowest, const Ball& highest,
                 GainNetwork& network) {
  const std::size_t n = network.states();
  for (std::size_t input = 0; input < inputs.size(); ++input) {
    if (!inputs[input].ripple) {
      continue;
    }
    std::vector<Ball> angle(n, zero);
    for (const auto& [state, factor] : inputs[input].ripple->angle) {
      angle[state] = factor;
    }
    GainRipple ripple;
    ripple.input = input;
    ripple.turns = inputs[input].ripple->turns;
    ripple.size = inputs[input].ripple->size;
    ripple.angle_form = network.forms.size();
    network.forms.push_back({angle, {}});
    ripple.change_form = network.forms.size();
    network.forms.push_back(change_of(network, angle));
    network.ripples.push_back(std::move(ripple));
  }
  std::vector<std::vector<Ball>> rows;
  for (const GainForm& form : network.forms) {
    rows.push_back(form.row);
  }
  for (std::size_t i = 0; i < n; ++i) {
    rows.emplace_back(n, zero);
    rows.back()[i] = one;
  }
  for (GainRipple& ripple : network.ripples) {
    const Responses largest = largest_responses(network, ripple, rows, lowest, highest);
    for (const Ball& each : largest.of_row) {
      std::vector<Ball>& list =
          ripple.of_form.size() < network.forms.size() ? ripple.of_form : ripple.of_state;
      list.push_back((each * ripple.size).upper());
    }
    for (const Ball& each : largest.rest) {
      ripple.rest_of_state.push_back((each * ripple.size).upper());
    }
    ripple.direct = (largest.direct * ripple.size).upper();
  }
  for (const GainRipple& ripple : network.ripples) {
    network.inputs.push_back(direct_drift_of(network, ripple));
  }
  for (std::size_t i = 0; i < n && !network.ripples.empty(); ++i) {
    network.inputs.push_back(drift_of(network, i));
  }
}

}  // namespace veritrack::checker
