#include "checker/model/gain/phase_group.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "checker/numbers/threads.hpp"

namespace veritrack::checker {

namespace {

double parts_of_turn(const Ball& frequency, std::size_t phases, bool above) {
  const Ball parts = frequency * Ball(static_cast<double>(phases)) / (two * pi());
  return above ? parts.upper_double() : parts.lower_double();
}

}  // namespace

PhaseGroup::PhaseGroup(std::vector<const PhasePart*> parts, std::size_t phases, const PhaseHorizon& horizon,
                       double slew)
    : parts_(std::move(parts)), phases_(phases), slew_(slew) {
  if (parts_.empty() || !(slew >= 0.0) || (slew == 0.0 && parts_.size() != 1)) {
    return;
  }
  if (slew > 0.0) {
    flat_.reserve(parts_.size());
    for (const PhasePart*& part : parts_) {
      flat_.push_back(without_lean(*part));
      part = &flat_.back();
    }
  }
  std::vector<Widened> all;
  for (const PhasePart* part : parts_) {
    std::optional<Widened> wide_part = widened(*part);
    if (!wide_part) {
      return;
    }
    all.push_back(*std::move(wide_part));
  }
  std::vector<std::optional<PhaseKernels>> kernels(parts_.size());
  const auto find_kernels = [&](std::size_t number) {
    const PhasePart& part = *parts_[number];
    PhaseLoop loop;
    loop.phases = phases;
    loop.horizon = horizon;
    loop.low = parts_of_turn(part.lowest, phases, false);
    loop.high = parts_of_turn(part.highest, phases, true);
    loop.slew = slew == 0.0 ? 0.0 : parts_of_turn(Ball(slew), phases, true);
    loop.matrix = part.matrix;
    loop.forms = part.forms;
    loop.inputs = part.inputs;
    loop.stages = stages(all, number);
    loop.has_one_size.assign(part.inputs.size(), false);
    loop.has_one_size[PhasePart::kNoise] = loop.has_one_size[PhasePart::kSlew] = true;
    kernels[number].emplace(loop);
    return kernels[number]->is_valid();
  };
  if (first_failure(kernels.size(), find_kernels) < kernels.size()) {
    return;
  }
  kernels_.reserve(kernels.size());
  for (std::optional<PhaseKernels>& each : kernels) {
    kernels_.push_back(*std::move(each));
  }
  is_certain_ = close(all);
}

std::vector<const Table*> PhaseGroup::defects() const {
  std::vector<const Table*> all;
  for (const PhaseKernels& kernels : kernels_) {
    all.push_back(&kernels.defect());
  }
  return all;
}

bool PhaseGroup::add_steady(const std::vector<double>& sizes, Table& of_forms) const {
  Table totals;
  for (const PhaseKernels& kernels : kernels_) {
    totals.push_back(kernels.total_of(sizes));
  }
  const std::optional<std::vector<double>> bound = closed_together(defects(), totals);
  if (!bound) {
    return false;
  }
  const std::size_t forms = parts_.front()->forms.size();
  for (const PhaseKernels& kernels : kernels_) {
    of_forms.emplace_back();
    for (std::size_t form = 0; form < forms; ++form) {
      of_forms.back().push_back(kernels.of_form(form, *bound));
    }
  }
  return true;
}

bool PhaseGroup::close(const std::vector<Widened>& all) {
  const std::size_t n = parts_.front()->off.size();
  std::vector<double> residual(n, 0.0);
  std::vector<double> rounding(n, 0.0);
  for (const Widened& part : all) {
    raise_all(residual, part.residual);
    raise_all(rounding, part.rounding);
  }
  Table units;
  for (const PhaseKernels& kernels : kernels_) {
    units.push_back(kernels.total_of(std::vector<double>(n, 1.0)));  // at least 1: powers begin with I
  }
  // Which shows that the spectral radius of the defects is below 1, whatever the columns are.
  const std::optional<std::vector<double>> all_die_out = closed_together(defects(), units);
  if (!all_die_out || !add_steady(residual, residuals_) || !add_steady(rounding, roundings_)) {
    return false;
  }
  const std::size_t inputs = parts_.front()->inputs.size();
  const std::size_t forms = parts_.front()->forms.size();
  rests_.assign(kernels_.size(), Table(forms, std::vector<double>(inputs)));
  for (std::size_t input = 0; input < inputs; ++input) {
    Table totals;
    for (const PhaseKernels& kernels : kernels_) {
      totals.push_back(kernels.total(input));
    }
    const std::optional<std::vector<double>> bound = closed_together(defects(), totals);
    if (!bound) {
      return false;
    }
    for (std::size_t part = 0; part < kernels_.size(); ++part) {
      for (std::size_t form = 0; form < forms; ++form) {
        rests_[part][form][input] = kernels_[part].rest(form, input, *bound);
      }
    }
  }
  return true;
}

std::vector<double> PhaseGroup::components(std::size_t part, const std::vector<double>& start) const {
  return product_above(parts_[part]->inverse, start);
}

std::optional<Table> PhaseGroup::late_starts(const std::vector<double>& start) const {
  Table most;
  std::vector<double> all(start.size(), 0.0);
  for (std::size_t part = 0; part < kernels_.size(); ++part) {
    raise_all(all, components(part, start));
  }
  for (const PhaseKernels& kernels : kernels_) {
    most.push_back(kernels.largest_from(0, all));
  }
  const std::optional<std::vector<double>> bound = closed_together(defects(), most);
  if (!bound) {
    return std::nullopt;
  }
  Table late;
  for (const PhaseKernels& kernels : kernels_) {
    late.push_back(product_above(kernels.defect(), *bound));
  }
  return late;
}

}  // namespace veritrack::checker
