#include "checker/model/gain/phase_part.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "checker/model/gain/exact_number.hpp"
#include "checker/model/place_powers.hpp"

namespace veritrack::checker {

namespace {

/// A function over a cell of phases at one end of the frequencies: its values at both ends of the cell, how
/// far it is from the line between them where it is bent by s^2, and at most otherwise. It is linear in z
/// between both ends, but for what is in the distance.
struct Chord {
  double left = 0.0, right = 0.0, bend = 0.0, distance = 0.0;
};

/// At z = -1 or 1. |s - s^3| and 1 - s^4 are at most 2/27^(1/2) and 1.
Chord chord_of(const BallPolynomial& x, double z) {
  constexpr std::array<double, 5> kFromChord = {0.0, 0.0, 0.0, 0.3850, 1.0};
  Chord chord;
  const std::span<const double> places = x.block(0, 0);
  std::array<double, 5> by_s{};
  double size = 0.0;
  for (std::size_t place = 0; place < places.size(); ++place) {
    const Powers powers = powers_at(place);
    const double coefficient = places[place];
    size += std::abs(coefficient);
    if (powers.of_z > 1) {
      chord.distance += std::abs(coefficient);
    } else {
      by_s.at(static_cast<std::size_t>(powers.of_s)) += powers.of_z == 0 ? coefficient : z * coefficient;
    }
  }
  for (std::size_t s = 0; s < by_s.size(); ++s) {
    chord.left += s % 2 == 0 ? by_s[s] : -by_s[s];
    chord.right += by_s[s];
    chord.distance += kFromChord[s] * std::abs(by_s[s]);
  }
  chord.bend = by_s[2];
  chord.distance = up(chord.distance + x.error() + upward_product(0x1p-46, size));
  return chord;
}

/// sup |x - (low (1 - z) + high (1 + z))/2|.
double distance_from_ends(const BallPolynomial& x, double low, double high) {
  const std::span<const double> places = x.block(0, 0);
  double distance = 0.0;
  double size = std::abs(low) + std::abs(high);
  for (std::size_t place = 0; place < places.size(); ++place) {
    const Powers powers = powers_at(place);
    const double of_line = powers.of_s > 0 || powers.of_z > 1 ? 0.0
                           : powers.of_z == 0                 ? 0.5 * low + 0.5 * high
                                                              : 0.5 * high - 0.5 * low;
    distance += std::abs(places[place] - of_line);
    size += std::abs(places[place]);
  }
  return up(distance + x.error() + upward_product(0x1p-46, size));
}

/// How far a function is from a line whose ends are `left` and `right` above those of its chord: bend (s^2 -
/// 1) goes from -bend to 0.
double distance_from(const Chord& chord, double left, double right) {
  const double middle = 0.5 * (left + right);
  const double ends = up(std::abs(0.5 * (right - left)) + 0x1p-46 * (std::abs(left) + std::abs(right)));
  return up(chord.distance + std::max(std::abs(middle), up(std::abs(chord.bend + middle))) + ends);
}

using Chords = std::vector<std::vector<std::array<Chord, 2>>>;  ///< by component, cell of phases and end

/// A vector function of all phases: from its chords. The values are moved by half the bend towards it, so
/// that the function is on both sides of the line.
GridFunction grid_from(const Chords& chords) {
  GridFunction result;
  const std::size_t phases = chords.empty() ? 0 : chords.front().size();
  result.values.fill(Table(phases, std::vector<double>(chords.size())));
  for (std::size_t i = 0; i < chords.size(); ++i) {
    double error = 0.0;
    bool is_known = true;
    for (const std::size_t end : {0U, 1U}) {
      Table& values = result.values.at(end);
      for (std::size_t g = 0; g < phases; ++g) {
        const Chord& chord = chords[i][g].at(end);
        values[g][i] = chord.left - 0.25 * (chord.bend + chords[i][(g + phases - 1) % phases].at(end).bend);
      }
      for (std::size_t g = 0; g < phases; ++g) {
        const Chord& chord = chords[i][g].at(end);
        const double left = values[g][i];
        const double distance =
            distance_from(chord, left - chord.left, values[(g + 1) % phases][i] - chord.right);
        const double size = std::abs(chord.left) + std::abs(chord.right) + std::abs(left);
        const double whole = up(distance + upward_product(0x1p-46, size));
        is_known = is_known && std::isfinite(whole);
        error = std::max(error, whole);
      }
    }
    result.error.push_back(is_known ? error : HUGE_VAL);
  }
  return result;
}

/// Adds a cell of phases.
void add_cell(Chords& chords, const PolynomialRow& row) {
  chords.resize(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    chords[i].push_back({chord_of(row[i], -1.0), chord_of(row[i], 1.0)});
  }
}

void raise(double& most, const BallPolynomial& value) {
  most = std::max(most, largest_over_cell(value));
}

void raise(Table& most, const PolynomialMatrix& matrix) {
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < matrix[i].size(); ++j) {
      raise(most[i][j], matrix[i][j]);
    }
  }
}

/// Near the polynomials of the certificate at z.
Table matrix_near(const PhaseCell& cell, double z, std::size_t n) {
  Table matrix(n, std::vector<double>(n));
  for (std::size_t i = 0; i < n * n; ++i) {
    double value = 0.0;
    for (std::size_t d = cell.matrix[i].size(); d-- > 0;) {
      value = value * z + cell.matrix[i][d];
    }
    matrix[i / n][i % n] = value;
  }
  return matrix;
}

/// sum over h and d of d (d - 1) |c_hd|/D^2.
Ball bound_of_second_derivative(const PhaseSeries& series, double half_width) {
  Ball sum;
  for (const auto& harmonic : series) {
    for (std::size_t d = 2; d < harmonic.size(); ++d) {
      const Ball size = sqrt(square(Ball(harmonic[d].real())) + square(Ball(harmonic[d].imag())));
      sum += Ball(static_cast<double>(d * (d - 1))) * size;
    }
  }
  return sum / square(Ball(half_width));
}

/// Collects what the runs over all cells of phases say.
class PartCollection {
 public:
  PartCollection(const PhaseStructure& structure, const PhaseCell& cell, const TubePart& place)
      : structure_(&structure), forms_(structure.forms.size()) {
    const std::size_t n = structure.states;
    part_.matrix = {matrix_near(cell, place.z - place.half_z, n),
                    matrix_near(cell, place.z + place.half_z, n)};
    part_.off.assign(n, std::vector<double>(n, 0.0));
    part_.inverse.assign(n, std::vector<double>(n, 0.0));
    part_.turned = part_.inverse;
    part_.matrix_low.assign(n, std::vector<double>(n, HUGE_VAL));
    part_.matrix_high.assign(n, std::vector<double>(n, -HUGE_VAL));
    part_.residual.assign(n, 0.0);
    part_.rounding.of_step.assign(n, 0.0);
    part_.half_width = cell.tube.half_width;
    for (std::size_t i = 0; i < n; ++i) {
      part_.curve_bend.push_back(upper(bound_of_second_derivative(cell.tube.curve[i], part_.half_width)));
      part_.basis_bend.emplace_back();
      for (std::size_t j = 0; j < n; ++j) {
        part_.basis_bend.back().push_back(
            upper(bound_of_second_derivative(cell.tube.shape[i * n + j], part_.half_width)));
      }
    }
    columns_.resize(structure.channels + structure.inputs.size());
  }

  void add(PhaseRun run, const RoundedProgram* program) {
    if (program != nullptr) {
      part_.rounding.raise(rounding_over(*program, run));
    }
    const std::size_t n = structure_->states;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const DoubleRange entry = range_over_cell(run.columns[j][i]);
        part_.matrix_low[i][j] = std::min(part_.matrix_low[i][j], entry.low);
        part_.matrix_high[i][j] = std::max(part_.matrix_high[i][j], entry.high);
        const double off =
            distance_from_ends(run.columns[j][i], part_.matrix[0][i][j], part_.matrix[1][i][j]);
        part_.off[i][j] = std::isfinite(off) ? std::max(part_.off[i][j], off) : HUGE_VAL;
      }
      raise(part_.residual[i], run.residual[i]);
    }
    raise(part_.inverse, run.inverse);
    raise(part_.turned, run.turned);
    for (std::size_t form = 0; form < forms_.size(); ++form) {
      add_cell(forms_[form], run.forms[form]);
    }
    for (std::size_t column = 0; column < columns_.size(); ++column) {
      add_cell(columns_[column], run.columns[n + column]);
    }
    add_cell(slew_, run.slew);
    part_.cells.push_back({std::move(run.rules), std::move(run.direct), std::move(run.to_input),
                           range_over_cell(run.bias), range_over_cell(run.bias.mean_over_phase())});
  }

  [[nodiscard]] PhasePart part() {
    for (const Chords& chords : forms_) {
      part_.forms.push_back(grid_from(chords));
    }
    part_.inputs.push_back(
        {grid_from(columns_[0]), structure_->channels > 1 ? grid_from(columns_[1]) : GridFunction{}});
    part_.inputs.push_back({grid_from(slew_), {}});
    for (std::size_t column = structure_->channels; column < columns_.size(); ++column) {
      part_.inputs.push_back({grid_from(columns_[column]), {}});
    }
    return std::move(part_);
  }

 private:
  const PhaseStructure* structure_;
  PhasePart part_;
  std::vector<Chords> forms_, columns_;
  Chords slew_;
};

bool is_known(const PhasePart& part, std::size_t phases, std::size_t states) {
  const auto is_size = [](double x) { return std::isfinite(x) && x >= 0.0; };
  const auto are_sizes = [&](const std::vector<double>& row) {
    return std::all_of(row.begin(), row.end(), is_size);
  };
  const auto are_rows = [&](const Table& table) {
    return std::all_of(table.begin(), table.end(), are_sizes);
  };
  const auto is_grid = [&](const GridFunction& f) { return is_grid_function(f, phases, states); };
  for (std::size_t i = 0; i < states * states; ++i) {
    const double low = part.matrix_low[i / states][i % states];
    const double high = part.matrix_high[i / states][i % states];
    if (!(std::isfinite(low) && std::isfinite(high) && low <= high)) {
      return false;
    }
  }
  return are_rows(part.off) && are_rows(part.inverse) && are_rows(part.turned) && are_rows(part.basis_bend) &&
         are_sizes(part.residual) && are_sizes(part.rounding.of_step) && are_sizes(part.rounding.of_start) &&
         is_size(part.rounding.of_frequency) && are_sizes(part.curve_bend) && part.cells.size() == phases &&
         std::all_of(part.forms.begin(), part.forms.end(), is_grid) &&
         std::all_of(part.inputs.begin(), part.inputs.end(), [&](const PhaseInput& input) {
           return is_grid(input.first) && (input.second.is_empty() || is_grid(input.second));
         });
}

}  // namespace

PhasePart without_lean(PhasePart part) {
  for (GridFunction& form : part.forms) {
    form = without_lean(std::move(form));
  }
  for (PhaseInput& input : part.inputs) {
    input.first = without_lean(std::move(input.first));
    input.second = without_lean(std::move(input.second));
  }
  for (std::size_t i = 0; i < part.off.size(); ++i) {
    for (std::size_t j = 0; j < part.off.size(); ++j) {
      const double middle = 0.5 * part.matrix[0][i][j] + 0.5 * part.matrix[1][i][j];
      part.matrix[0][i][j] = part.matrix[1][i][j] = middle;
      part.off[i][j] =
          up(std::max(std::abs(part.matrix_high[i][j] - middle), std::abs(part.matrix_low[i][j] - middle)));
    }
  }
  return part;
}

TubePart place_of_part(std::size_t part, std::size_t parts, std::size_t phase, std::size_t phases) {
  const auto count = static_cast<double>(parts);
  TubePart place = TubePart::of_grid(phase, phases, 0, 1);
  place.z = (static_cast<double>(2 * part + 1) - count) / count;
  place.half_z = (1.0 + 0x1p-36) / count;  // more than the rounding of both takes away
  return place;
}

PhasePart phase_part(const PhaseStructure& structure, const TrackedModel& model, const PhaseCell& cell,
                     std::size_t part, std::size_t phases, const RoundedProgram* program) {
  const TubePart whole = place_of_part(part, cell.parts, 0, phases);
  PartCollection collection(structure, cell, whole);
  for (std::size_t g = 0; g < phases; ++g) {
    collection.add(run_over(structure, model, cell, place_of_part(part, cell.parts, g, phases)), program);
  }
  PhasePart result = collection.part();
  const Ball width(cell.tube.half_width);
  const Ball middle = Ball(cell.tube.frequency) + width * Ball(whole.z);
  result.lowest = (middle - width * Ball(whole.half_z)).lower();
  result.highest = (middle + width * Ball(whole.half_z)).upper();
  if (!is_known(result, phases, structure.states)) {
    throw NotCovered("a slope of the step is not bounded");
  }
  return result;
}

}  // namespace veritrack::checker
