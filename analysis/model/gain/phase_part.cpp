#include "analysis/model/gain/phase_part.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/larger_or_nan.hpp"

namespace veritrack::model {

using rigor::BallModel;
using rigor::Interval;
using rigor::larger_or_nan;

namespace {

/// The parts overlap by this, relative to their width: their middles are rounded.
constexpr double kOverlap = 1e-9;

Interval polynomial(const std::vector<double>& coefficients, const Interval& z) {
  Interval sum(0.0);
  for (std::size_t d = coefficients.size(); d-- > 0;) {
    sum = sum * z + Interval(coefficients[d]);
  }
  return sum;
}

/// A bound of the second derivative by the frequency.
double bend_of(const PhaseSeries& series, double half_width) {
  Interval sum(0.0);
  for (const auto& of_harmonic : series.coefficients) {
    for (std::size_t d = 2; d < of_harmonic.size(); ++d) {
      // |re| + |im| is not less than the absolute value.
      sum += Interval(static_cast<double>(d * (d - 1))) *
             (Interval(std::fabs(of_harmonic[d].real())) + Interval(std::fabs(of_harmonic[d].imag())));
    }
  }
  return (sum / rigor::square(Interval(half_width))).upper();
}

double size_of(const BallModel& model) {
  const Interval range = model.range();
  return is_empty(range) ? NAN : rigor::magnitude(range);
}

/// What a program is off in a step.
void add_rounding(const PhaseStep& step, PhasePart& part) {
  part.rounding.resize(part.states, 0.0);
  part.rounding_of_start.resize(part.states, 0.0);
  for (std::size_t i = 0; i < part.states; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < part.states; ++j) {
      sum += size_of(step.inverse[i][j]) * step.rounding[j];
    }
    part.rounding[i] = larger_or_nan(part.rounding[i], sum);
    part.rounding_of_start[i] = larger_or_nan(part.rounding_of_start[i], step.rounding[i]);
  }
  part.rounding_of_frequency = larger_or_nan(part.rounding_of_frequency, step.rounding.back());
}

/// Adds the suprema of a step's matrices to those of the part. False where one is not known.
bool add_step(const PhaseStep& step, bool is_first, PhasePart& part) {
  const std::size_t n = part.states;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const Interval range = step.matrix[i][j].range();
      if (is_empty(range)) {
        return false;
      }
      Interval& entry = part.matrix[i * n + j];
      entry = is_first ? range : hull(entry, range);
      double& off = part.off[i * n + j];
      off = larger_or_nan(
          off, distance_from_line(step.matrix[i][j], part.middle[i * n + j], part.lean[i * n + j]));
      double& inverse = part.inverse[i * n + j];
      inverse = larger_or_nan(inverse, size_of(step.inverse[i][j]));
      double& slope = part.basis_slope[i * n + j];
      slope = larger_or_nan(slope, size_of(step.basis_slope[i][j]));
    }
    part.residual[i] = larger_or_nan(part.residual[i], size_of(step.residual[i]));
  }
  if (!step.rounding.empty()) {
    add_rounding(step, part);
  }
  PhaseNetwork cell;
  cell.inputs = step.inputs;
  for (const PhaseForm& form : step.forms) {
    cell.direct.push_back(form.direct);
  }
  cell.bias = step.bias.range();
  cell.mean_bias = step.bias.mean_over_s();
  part.cells.push_back(std::move(cell));
  if (is_first) {
    part.frequency_state = step.frequency_state;
  } else if (!step.frequency_state || !part.frequency_state ||
             step.frequency_state->first != part.frequency_state->first) {
    part.frequency_state.reset();
  } else {
    part.frequency_state->second = hull(part.frequency_state->second, step.frequency_state->second);
  }
  return !is_empty(step.bias.range());
}

void find_grid_functions(const std::vector<PhaseStep>& steps, PhasePart& part) {
  const std::size_t n = part.states;
  const PhaseStep& first = steps.front();
  const auto on_grid = [&](auto models) {
    return grid_function(n, steps.size(), [&](std::size_t g, std::size_t i) -> const BallModel& {
      return models(steps[g])[i];
    });
  };
  for (std::size_t f = 0; f < first.forms.size(); ++f) {
    part.forms.push_back(on_grid([f](const PhaseStep& step) -> const auto& { return step.forms[f].states; }));
  }
  for (const auto& [input, column] : first.columns) {
    GridFunction function =
        on_grid([input = input](const PhaseStep& step) -> const auto& { return step.columns.at(input); });
    if (first.inputs[static_cast<std::size_t>(input)].is_noise) {
      part.noise.push_back(std::move(function));
    } else {
      part.columns.emplace(input, std::move(function));
    }
  }
  part.slew = on_grid([](const PhaseStep& step) -> const auto& { return step.slew; });
}

/// The effect of the bends of basis and curve over the frequency.
void find_bends(const FloquetCell& cell, PhasePart& part) {
  const std::size_t n = part.states;
  part.slew_bend.assign(n, 0.0);
  part.basis_bend.assign(n * n, 0.0);
  for (std::size_t m = 0; m < n; ++m) {
    const double of_curve = 0.5 * bend_of(cell.curve.curve[m], cell.curve.half_width);
    for (std::size_t i = 0; i < n; ++i) {
      part.slew_bend[i] += part.inverse[i * n + m] * of_curve;
    }
    for (std::size_t j = 0; j < n; ++j) {
      const double of_basis = 0.5 * bend_of(cell.basis[m * n + j], cell.curve.half_width);
      for (std::size_t i = 0; i < n; ++i) {
        part.basis_bend[i * n + j] += part.inverse[i * n + m] * of_basis;
      }
    }
  }
}

/// A bound of the sum of the powers of a matrix of absolute values, from the first on; empty where its rows
/// do not add up to less than a half.
std::optional<std::vector<double>> sum_of_powers(const std::vector<double>& matrix, std::size_t n) {
  double q = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    double row = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      row += matrix[i * n + j];
    }
    q = larger_or_nan(q, row);
  }
  if (!(q < 0.5)) {
    return std::nullopt;
  }
  std::vector<double> sum = matrix;
  for (std::size_t j = 0; j < n; ++j) {
    double most = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      most = std::max(most, matrix[i * n + j]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      sum[i * n + j] += 2.0 * q * most;  // each further power adds q times as much, to all of the column
    }
  }
  return sum;
}

}  // namespace

std::optional<PhasePart> phase_part(const TrackerModel& tracker, const FloquetCell& cell,
                                    const PhaseGridding& gridding, std::size_t number) {
  const rigor::BallModelScope scope(0, 0);
  const std::size_t n = cell.states();
  TubeCell place;
  place.half_turn = 0.5 / static_cast<double>(gridding.phases);
  place.half_z = (1.0 + kOverlap) / static_cast<double>(gridding.parts);
  place.z = static_cast<double>(2 * number + 1) / static_cast<double>(gridding.parts) - 1.0;
  PhasePart part;
  part.states = n;
  part.matrix.resize(n * n);
  part.inverse.assign(n * n, 0.0);
  part.basis_slope.assign(n * n, 0.0);
  part.off.assign(n * n, 0.0);
  part.residual.assign(n, 0.0);
  for (const std::vector<double>& entry : cell.matrix) {
    const double low = rigor::midpoint(polynomial(entry, Interval(place.z - place.half_z)));
    const double high = rigor::midpoint(polynomial(entry, Interval(place.z + place.half_z)));
    part.middle.push_back(0.5 * (low + high));
    part.lean.push_back(0.5 * (high - low));
  }
  std::vector<PhaseStep> steps;
  steps.reserve(gridding.phases);
  for (std::size_t g = 0; g < gridding.phases; ++g) {
    place.turn = static_cast<double>(2 * g + 1) * place.half_turn;
    steps.push_back(phase_step(tracker, cell, place));
    if (!add_step(steps.back(), g == 0, part)) {
      return std::nullopt;
    }
  }
  find_grid_functions(steps, part);
  find_bends(cell, part);
  const Interval middle =
      Interval(cell.curve.frequency) + Interval(cell.curve.half_width) * Interval(place.z);
  part.frequency = rigor::midpoint(middle);
  part.half_width =
      (Interval(cell.curve.half_width) * Interval(place.half_z) + middle - Interval(part.frequency)).upper();
  return part;
}

std::optional<PhasePart> with_slew(PhasePart part, double slew) {
  if (slew == 0.0) {
    return part;
  }
  const std::size_t n = part.states;
  std::vector<double> change(n * n);  // W Q
  for (std::size_t i = 0; i < n * n; ++i) {
    change[i] = slew * (part.basis_slope[i] + slew * part.basis_bend[i]);
  }
  const auto psi = sum_of_powers(change, n);
  if (!psi) {
    return std::nullopt;
  }
  const auto times = [&](const std::vector<double>& sizes) {
    std::vector<double> result(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        result[i] += (*psi)[i * n + j] * sizes[j];
      }
    }
    return result;
  };
  for (GridFunction& each : part.forms) {
    each = without_lean(each);
  }
  const auto widen = [&](GridFunction& column) {
    column = without_lean(column);
    std::vector<double> sizes = column.largest;
    for (std::size_t i = 0; i < n; ++i) {
      sizes[i] += column.error[i];
    }
    const std::vector<double> more = times(sizes);
    for (std::size_t i = 0; i < n; ++i) {
      column.error[i] += more[i];
    }
  };
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<double> column(n);
    for (std::size_t i = 0; i < n; ++i) {
      column[i] = rigor::magnitude(part.matrix[i * n + j]);
    }
    const std::vector<double> more = times(column);
    for (std::size_t i = 0; i < n; ++i) {
      part.matrix[i * n + j] += Interval::from_bounds(-more[i], more[i]);
    }
    part.slew.error[j] += slew * part.slew_bend[j];
  }
  for (std::size_t i = 0; i < n * n; ++i) {
    part.lean[i] = 0.0;
    part.off[i] = rigor::magnitude(part.matrix[i] - Interval(part.middle[i]));
  }
  for (GridFunction& each : part.noise) {
    widen(each);
  }
  for (auto& [input, each] : part.columns) {
    widen(each);
  }
  widen(part.slew);
  for (std::vector<double>* each : {&part.residual, &part.rounding}) {
    if (each->empty()) {
      continue;  // nothing is rounded
    }
    const std::vector<double> more = times(*each);
    for (std::size_t i = 0; i < n; ++i) {
      (*each)[i] += more[i];
    }
  }
  return part;
}

}  // namespace veritrack::model
