#include "checker/model/gain/phase_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "checker/numbers/threads.hpp"

namespace veritrack::checker {

namespace {

/// Bounds of a group of parts, by cell of phases.
struct GroupErrors {
  std::shared_ptr<const PhaseGroup> group;
  PhaseTable for_ever;
  std::vector<double> late;  ///< of the frequency, in the long run
  std::unique_ptr<PhaseSolver> solver;
};

double size_of(const DoubleRange& range) {
  return largest_in(range);
}

class PhaseErrors : public FrequencyErrors {
 public:
  /// `rounding`: what the program's frequency is off from that of its states.
  PhaseErrors(std::vector<GroupErrors> errors, std::size_t form, Ball rounding)
      : errors_(std::move(errors)), form_(form), rounding_(std::move(rounding)) {}

  [[nodiscard]] Ball for_ever() const override {
    return largest([](const GroupErrors& each) { return each.for_ever; }, form_) + rounding_;
  }
  [[nodiscard]] Ball from(const Ball& sample) const override {
    const double whole = std::floor(sample.lower_double());
    const std::size_t first = whole >= 0x1p20 ? std::size_t{1} << 20U
                              : whole >= 0.0  ? static_cast<std::size_t>(whole)
                                              : 0;
    double most = 0.0;
    for (const GroupErrors& of : errors_) {
      const Table later = of.solver->errors_from(first, of.for_ever);
      for (std::size_t part = 0; part < later.size(); ++part) {
        for (std::size_t g = 0; g < later[part].size(); ++g) {
          most = larger_error(most, later[part][g], of.group->part(part).cells[g].bias);
        }
      }
    }
    return min(Ball(most) + rounding_, for_ever());
  }
  [[nodiscard]] Ball in_long_run() const override {
    return largest([](const GroupErrors& each) { return Table{each.late}; }, 0) + rounding_;
  }
  [[nodiscard]] Range mean() const override {
    Range all(Ball::everything());
    bool is_first = true;
    for (const GroupErrors& of : errors_) {
      const Ball most = Ball(*std::max_element(of.late.begin(), of.late.end())) + rounding_;
      for (std::size_t part = 0; part < of.group->size(); ++part) {
        Ball low;
        Ball high;
        for (const PhaseCellValues& cell : of.group->part(part).cells) {
          low += Ball(cell.mean_bias.low);
          high += Ball(cell.mean_bias.high);
        }
        const Ball phases(static_cast<double>(of.group->phases()));
        low = low / phases - most;
        high = high / phases + most;
        all = {is_first ? low : min(all.low, low), is_first ? high : max(all.high, high)};
        is_first = false;
      }
    }
    return all;
  }
  [[nodiscard]] Ball variation() const override {
    Ball most;
    for (const GroupErrors& of : errors_) {
      const std::vector<double>& late = of.late;
      for (std::size_t part = 0; part < of.group->size(); ++part) {
        const std::vector<PhaseCellValues>& cells = of.group->part(part).cells;
        Ball low(cells[0].bias.low);
        Ball high(cells[0].bias.high);
        for (std::size_t g = 0; g < cells.size(); ++g) {
          low = g == 0 ? low - Ball(late[0]) : min(low, Ball(cells[g].bias.low) - Ball(late[g]));
          high = g == 0 ? high + Ball(late[0]) : max(high, Ball(cells[g].bias.high) + Ball(late[g]));
        }
        most = max(most, high - low);
      }
    }
    return errors_.empty() ? Ball::everything() : most + two * rounding_;
  }

 private:
  static double larger_error(double most, double deviation, const DoubleRange& bias) {
    const double error = up(deviation + size_of(bias));
    return std::isfinite(error) ? std::max(most, error) : HUGE_VAL;
  }
  template <typename Bounds>
  [[nodiscard]] Ball largest(const Bounds& bounds, std::size_t row) const {
    double most = errors_.empty() ? HUGE_VAL : 0.0;
    for (const GroupErrors& of : errors_) {
      const Table table = bounds(of);
      for (std::size_t part = 0; part < of.group->size(); ++part) {
        for (std::size_t g = 0; g < table[row].size(); ++g) {
          most = larger_error(most, table[row][g], of.group->part(part).cells[g].bias);
        }
      }
    }
    return Ball(most);
  }

  std::vector<GroupErrors> errors_;
  std::size_t form_;
  Ball rounding_;
};

/// A little below bounds of another group, so that the search goes upward.
PhaseTable below(const PhaseTable& bounds) {
  PhaseTable result = bounds;
  for (std::vector<double>& row : result) {
    for (double& bound : row) {
      bound *= 1.0 - 0x1p-6;
    }
  }
  return result;
}

/// `before`: bounds of another group, to begin near them; or null. False where there are none.
bool bound_group(const PhaseLoopEvidence& evidence, const std::shared_ptr<const PhaseGroup>& group,
                 double noise, const std::vector<double>& start, const PhaseTable* before,
                 GroupErrors& errors) {
  if (!group->is_certain()) {
    return false;
  }
  auto solver = std::make_unique<PhaseSolver>(evidence, *group, noise, start);
  std::optional<PhaseTable> bounds;
  if (before != nullptr) {
    const PhaseTable near = below(*before);
    bounds = solver->for_ever(&near);
  }
  if (!bounds) {
    bounds = solver->for_ever(nullptr);
  }
  if (!bounds) {
    return false;
  }
  std::vector<double> late = solver->in_long_run(*bounds)[evidence.structure.error_form];
  errors = {group, *std::move(bounds), std::move(late), std::move(solver)};
  return true;
}

}  // namespace

const PhaseBounds::Groups& PhaseBounds::groups(double slew) const {
  if (slew_of_groups_ == slew) {
    return groups_;
  }
  groups_.clear();
  slew_of_groups_ = slew;
  std::vector<std::vector<const PhasePart*>> members;
  for (const std::vector<PhasePart>& cell : evidence_.cells) {
    for (const PhasePart& part : cell) {
      if (members.empty() || slew == 0.0) {
        members.emplace_back();
      }
      members.back().push_back(&part);
    }
  }
  groups_.resize(members.size());
  first_failure(members.size(), [&](std::size_t group) {
    groups_[group] = std::make_shared<const PhaseGroup>(std::move(members[group]), evidence_.phases,
                                                        evidence_.horizon, slew);
    return true;
  });
  return groups_;
}

bool PhaseBounds::is_certain(const Ball& slew) const {
  const Groups& all = groups(upper(slew));
  return !all.empty() && std::all_of(all.begin(), all.end(), [this](const auto& group) {
    if (!group->is_certain()) {
      return false;
    }
    for (std::size_t part = 0; part < group->size(); ++part) {
      if (!(group->of_residual(part, evidence_.structure.error_form) <= kMostOfResidual)) {
        return false;
      }
    }
    return true;
  });
}

std::unique_ptr<FrequencyErrors> PhaseBounds::errors(const Ball& noise, const Ball& slew,
                                                     const std::vector<Ball>& start) const {
  std::vector<double> deviations;
  deviations.reserve(start.size());
  for (const Ball& deviation : start) {
    deviations.push_back(certainly_not_negative(deviation) ? upper(deviation) : HUGE_VAL);
  }
  add_rounding_of_start(deviations);
  const double most_noise = upper(noise);
  const double most_slew = upper(slew);
  if (evidence_.program && !(most_noise <= evidence_.program->most_noise)) {
    return nullptr;
  }
  if (start.size() != states() || !certainly_not_negative(noise) || !certainly_not_negative(slew) ||
      !std::isfinite(most_noise) || !std::isfinite(most_slew) ||
      !std::all_of(deviations.begin(), deviations.end(), [](double x) { return std::isfinite(x); }) ||
      (most_slew != 0.0 && evidence_.cells.size() != 1)) {
    return nullptr;
  }
  constexpr std::size_t kRun = 8;  // groups, whose bounds are near those of the one before
  const Groups& all = groups(most_slew);
  std::vector<GroupErrors> errors(all.size());
  const auto bound_run = [&](std::size_t run) {
    for (std::size_t g = run * kRun; g < std::min(all.size(), (run + 1) * kRun); ++g) {
      if (!bound_group(evidence_, all[g], most_noise, deviations,
                       g > run * kRun ? &errors[g - 1].for_ever : nullptr, errors[g])) {
        return false;
      }
    }
    return true;
  };
  const std::size_t runs = (all.size() + kRun - 1) / kRun;
  return runs == 0 || first_failure(runs, bound_run) < runs
             ? nullptr
             : std::make_unique<PhaseErrors>(std::move(errors), evidence_.structure.error_form,
                                             rounding_of_frequency());
}

Ball PhaseBounds::rounding_of_frequency() const {
  Ball most;
  for (const std::vector<PhasePart>& cell : evidence_.cells) {
    for (const PhasePart& part : cell) {
      most = max(most, Ball(part.rounding.of_frequency));
    }
  }
  return most;
}

void PhaseBounds::add_rounding_of_start(std::vector<double>& deviations) const {
  std::vector<double> most(deviations.size(), 0.0);
  for (const std::vector<PhasePart>& cell : evidence_.cells) {
    for (const PhasePart& part : cell) {
      for (std::size_t i = 0; i < std::min(most.size(), part.rounding.of_start.size()); ++i) {
        most[i] = std::max(most[i], part.rounding.of_start[i]);
      }
    }
  }
  for (std::size_t i = 0; i < most.size(); ++i) {
    deviations[i] = up(deviations[i] + most[i]);
  }
}

std::vector<Ball> PhaseBounds::starts_within(const Ball& reach) const {
  Ball bias;
  for (const std::vector<PhasePart>& cell : evidence_.cells) {
    for (const PhasePart& part : cell) {
      for (const PhaseCellValues& values : part.cells) {
        bias = max(bias, Ball(size_of(values.bias)));
      }
    }
  }
  std::vector<Ball> start(states());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const Ball& factor = evidence_.frequency_factors[i];
    if (!certainly_equal(factor, zero)) {
      ++moved;
      start[i] = (reach + bias + rounding_of_frequency()) / abs(factor);
    }
  }
  return moved == 1 ? start : std::vector<Ball>();
}

}  // namespace veritrack::checker
