// Bounds that contain their own right side.
#include "checker/model/gain/phase_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "checker/model/gain/phase_lags.hpp"

namespace veritrack::checker {

namespace {

constexpr int kMostPhaseRounds = 2000;
/// By how much bounds are above their right side in the search.
constexpr double kRoom = 1.0 + 0x1p-14;
/// Rounds from above, once bounds are found: each is a bound, too.
constexpr int kRoundsFromAbove = 12;

bool are_all_finite(const Table& table) {
  return !table.empty() && std::all_of(table.begin(), table.end(), [](const std::vector<double>& row) {
    return !row.empty() &&
           std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x) && x >= 0.0; });
  });
}

bool are_at_most(const Table& x, const Table& y) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < x[i].size(); ++j) {
      if (!(x[i][j] <= y[i][j])) {
        return false;
      }
    }
  }
  return are_all_finite(x) && are_all_finite(y);
}

/// The smaller ones; whether some are smaller by more than rounding.
bool lower(Table& bounds, const Table& other) {
  bool changes = false;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    for (std::size_t j = 0; j < bounds[i].size(); ++j) {
      if (other[i][j] < bounds[i][j]) {
        changes = changes || other[i][j] * kGrowth < bounds[i][j];
        bounds[i][j] = other[i][j];
      }
    }
  }
  return changes;
}

}  // namespace

/// The sizes of remainders and inputs where forms are at most some bounds.
struct PhaseSolver::Sizes {
  std::vector<Table> remainders;    ///< by part, rule and cell
  std::vector<Table> inputs;        ///< by part, input and cell
  std::vector<PhaseSizes> sources;  ///< by input: the largest of all parts
};

PhaseSolver::PhaseSolver(const PhaseLoopEvidence& evidence, const PhaseGroup& group, double noise,
                         const std::vector<double>& start)
    : evidence_(&evidence), group_(&group), noise_(noise), start_(start.size(), 0.0) {
  const std::size_t forms = evidence.structure.forms.size();
  const bool is_started = std::any_of(start.begin(), start.end(), [](double x) { return x != 0.0; });
  if (is_started) {
    late_starts_ = group.late_starts(start);
    for (std::size_t part = 0; part < group.size(); ++part) {
      const std::vector<double> eta = group.components(part, start);
      for (std::size_t i = 0; i < eta.size(); ++i) {
        start_[i] = std::max(start_[i], eta[i]);
      }
    }
  } else {
    late_starts_ = Table(group.size(), std::vector<double>(start.size(), 0.0));
  }
  const PhaseSizes of_noise(std::vector<double>(group.phases(), noise));
  const PhaseSizes of_slew(std::vector<double>(group.phases(), group.slew()));
  for (std::size_t part = 0; part < group.size(); ++part) {
    given_.emplace_back();
    given_rest_.emplace_back();
    starts_.emplace_back();
    for (std::size_t form = 0; form < forms; ++form) {
      EndSums sums{std::vector<double>(group.phases(), 0.0), std::vector<double>(group.phases(), 0.0)};
      group.kernels(part).add(form, PhasePart::kNoise, of_noise, sums);
      group.kernels(part).add(form, PhasePart::kSlew, of_slew, sums);
      given_.back().push_back(std::move(sums));
      given_rest_.back().push_back(up(upward_product(group.rest(part, form, PhasePart::kNoise), noise) +
                                      upward_product(group.rest(part, form, PhasePart::kSlew), group.slew()) +
                                      group.of_residual(part, form) + group.of_rounding(part, form)));
      starts_.back().push_back(is_started ? of_start(part, form, 0) : 0.0);
    }
  }
}

double PhaseSolver::of_start(std::size_t part, std::size_t form, std::size_t first) const {
  if (!late_starts_) {
    return HUGE_VAL;
  }
  const PhaseKernels& kernels = group_->kernels(part);
  return up(kernels.of_form(form, kernels.largest_from(first, start_)) +
            kernels.of_form(form, (*late_starts_)[part]));
}

bool PhaseSolver::keeps_room(const PhaseTable& bounds) const {
  const std::vector<std::size_t>& forms = evidence_->structure.state_forms;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    for (const double bound : bounds[forms[i]]) {
      if (!(bound < evidence_->program->room[i])) {
        return false;
      }
    }
  }
  return true;
}

std::optional<PhaseSolver::Sizes> PhaseSolver::sizes_at(const PhaseTable& bounds) const {
  const PhaseStructure& structure = evidence_->structure;
  const std::size_t phases = group_->phases();
  if (!keeps_room(bounds)) {
    return std::nullopt;
  }
  Sizes sizes;
  Table largest(structure.inputs.size(), std::vector<double>(phases, 0.0));
  for (std::size_t part = 0; part < group_->size(); ++part) {
    spend(static_cast<std::int64_t>(structure.rules.size() * phases));
    Table remainders(structure.rules.size(), std::vector<double>(phases, 0.0));
    Table inputs(structure.inputs.size(), std::vector<double>(phases, 0.0));
    for (std::size_t r = 0; r < structure.rules.size(); ++r) {
      const PhaseRule& rule = structure.rules[r];
      const PhaseNode& node = structure.graph.nodes[rule.node];
      for (std::size_t g = 0; g < phases; ++g) {
        const PhaseCellValues& cell = group_->part(part).cells[g];
        const double size = remainder_size(node, cell.rules[r], rule.first ? bounds[*rule.first][g] : 0.0,
                                           rule.second ? bounds[*rule.second][g] : 0.0);
        if (!std::isfinite(size)) {
          return std::nullopt;
        }
        remainders[r][g] = size;
        if (rule.input) {
          inputs[*rule.input][g] += upward_product(cell.to_input[r], size);
        }
      }
    }
    for (std::size_t input = 0; input < inputs.size(); ++input) {
      for (std::size_t g = 0; g < phases; ++g) {
        inputs[input][g] = up(inputs[input][g]);
        largest[input][g] = std::max(largest[input][g], inputs[input][g]);
      }
    }
    sizes.remainders.push_back(std::move(remainders));
    sizes.inputs.push_back(std::move(inputs));
  }
  for (const std::vector<double>& of_input : largest) {
    sizes.sources.emplace_back(of_input);
  }
  return sizes;
}

double PhaseSolver::direct(const Sizes& sizes, std::size_t part, std::size_t form, std::size_t cell) const {
  const PhaseStructure& structure = evidence_->structure;
  double sum = 0.0;
  double squares = 0.0;  // of the slopes by the components of the noise
  for (const auto& [variable, slope] : group_->part(part).cells[cell].direct[form]) {
    if (variable < structure.remainder(0)) {
      squares = up(squares + upward_product(slope, slope));
    } else if (variable < structure.input(0)) {
      sum += upward_product(slope, sizes.remainders[part][variable - structure.remainder(0)][cell]);
    } else {
      sum += upward_product(slope, sizes.inputs[part][variable - structure.input(0)][cell]);
    }
  }
  return up(sum + upward_product(noise_, up(std::sqrt(squares))));
}

std::vector<double> PhaseSolver::of_form(const Sizes& sizes, std::size_t part, std::size_t form,
                                         double start) const {
  EndSums sums = given_[part][form];
  double rest = given_rest_[part][form] + start;
  for (std::size_t input = 0; input < sizes.sources.size(); ++input) {
    const std::size_t number = PhasePart::kFirstOfRemainders + input;
    group_->kernels(part).add(form, number, sizes.sources[input], sums);
    rest += upward_product(group_->rest(part, form, number), sizes.sources[input].largest);
  }
  std::vector<double> result(sums.left.size());
  for (std::size_t g = 0; g < result.size(); ++g) {
    // The larger one of both ends; a value that is no number at one of them stays so.
    const double most = std::max(sums.left[g], sums.right[g]) + 0.0 * (sums.left[g] + sums.right[g]);
    result[g] = up(most * kManyRoundings + up(rest) + direct(sizes, part, form, g) + kManyUnderflows);
  }
  return result;
}

std::optional<PhaseTable> PhaseSolver::next(const PhaseTable& bounds, bool is_started) const {
  const std::optional<Sizes> sizes = sizes_at(bounds);
  if (!sizes) {
    return std::nullopt;
  }
  const std::size_t forms = evidence_->structure.forms.size();
  PhaseTable result(forms, std::vector<double>(group_->phases(), 0.0));
  for (std::size_t part = 0; part < group_->size(); ++part) {
    spend(static_cast<std::int64_t>(forms * sizes->sources.size() * group_->phases() * 8));
    for (std::size_t form = 0; form < forms; ++form) {
      const std::vector<double> of_part = of_form(*sizes, part, form, is_started ? starts_[part][form] : 0.0);
      for (std::size_t g = 0; g < of_part.size(); ++g) {
        if (!std::isfinite(of_part[g])) {
          return std::nullopt;
        }
        result[form][g] = std::max(result[form][g], of_part[g]);
      }
    }
  }
  return result;
}

std::optional<PhaseTable> PhaseSolver::for_ever(const PhaseTable* near) const {
  PhaseTable bounds(evidence_->structure.forms.size(), std::vector<double>(group_->phases(), 0.0));
  if (near != nullptr) {
    bounds = *near;
  }
  for (int round = 0; round < kMostPhaseRounds; ++round) {
    std::optional<PhaseTable> above = next(bounds, true);
    if (!above) {
      return std::nullopt;
    }
    if (are_at_most(*above, bounds)) {
      for (int down = 0; down < kRoundsFromAbove && above && lower(bounds, *above); ++down) {
        above = next(bounds, true);
      }
      return bounds;
    }
    for (std::vector<double>& of_form : *above) {
      for (double& bound : of_form) {
        bound *= kRoom;
      }
    }
    bounds = *std::move(above);
  }
  return std::nullopt;
}

PhaseTable PhaseSolver::in_long_run(PhaseTable bounds) const {
  for (int round = 0; round < kMostPhaseRounds; ++round) {
    const std::optional<PhaseTable> late = next(bounds, false);
    if (!late || !lower(bounds, *late)) {
      break;
    }
  }
  return bounds;
}

Table PhaseSolver::errors_from(std::size_t sample, const PhaseTable& for_ever) const {
  const std::optional<Sizes> sizes = sizes_at(for_ever);
  const std::size_t form = evidence_->structure.error_form;
  Table result;
  for (std::size_t part = 0; part < group_->size(); ++part) {
    const bool is_started = std::any_of(start_.begin(), start_.end(), [](double x) { return x != 0.0; });
    const double start = is_started ? of_start(part, form, sample) : 0.0;
    result.push_back(sizes ? of_form(*sizes, part, form, start)
                           : std::vector<double>(group_->phases(), HUGE_VAL));
  }
  return result;
}

}  // namespace veritrack::checker
