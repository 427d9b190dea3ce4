#include "analysis/quadrature/leak/steady_report.hpp"

#include <algorithm>

namespace veritrack::quadrature {

using rigor::Interval;
using rigor::Verdict;

SteadyReport::SteadyReport(const sets::ContractionQuestion& question, const sets::LockBranch& branch,
                           const SteadySet& set)
    : set_(set), starts_(follow_to_steady_set(question, branch.cells, set)), start_(joined(starts_)) {
  if (question.start_covariance) {
    covariance_range_ = question.start_covariance->range;
  }
  biases_.reserve(branch.cells.size());
  for (const auto& cell : branch.cells) {
    biases_.push_back(magnitude(sets::steady_state_error(cell).frequency_error));
  }
  bias_ = *std::max_element(biases_.begin(), biases_.end());
  if (!(question.slew == Interval(0.0))) {
    std::fill(biases_.begin(), biases_.end(), bias_);  // the frequency may move from cell to cell
  }
}

theorems::Condition SteadyReport::start_in_set() const {
  theorems::Condition condition{"start-in-set",
                                {},
                                start_.reached ? Verdict::proved : Verdict::undecided,
                                start_.level ? Interval(*start_.level) : Interval::empty(),
                                Interval(1.0),
                                {},
                                theorems::Sense::at_most};
  if (start_.reached && start_.samples != 0) {
    condition.lhs = Interval(start_.level_when_reached);
  }
  return condition;
}

Interval SteadyReport::radius(Eigen::Index i) const {
  return error_bounds(set_, Interval(1.0))[i];
}

std::optional<Interval> SteadyReport::bound() const {
  if (!start_.reached) {
    return std::nullopt;
  }
  Interval worst(start_.frequency_error);
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    // After the start, or after the sample at which it comes in, the states are in the next level.
    const double level = starts_[i].level_when_reached;
    const std::size_t next = std::min(last_level_with(level) + 1, set_.levels.size() - 1);
    worst = rigor::max(worst, bound_at(std::max(level, set_.levels[next]), biases_[i]));
  }
  return worst;
}

std::optional<Interval> SteadyReport::settling() const {
  if (!start_.reached) {
    return std::nullopt;
  }
  const std::size_t steps = set_.levels.size() - 1 - last_level_with(start_.level_when_reached);
  return Interval(static_cast<double>(steps) + start_.samples);
}

Interval SteadyReport::rate() const {
  Interval slowest(0.0);
  for (std::size_t j = 1; j < set_.levels.size(); ++j) {
    slowest = rigor::max(slowest, Interval(set_.levels[j]) / Interval(set_.levels[j - 1]));
  }
  return Interval(slowest.upper());
}

std::optional<Interval> SteadyReport::capture_samples() const {
  return start_.reached ? std::optional(Interval(start_.samples)) : std::nullopt;
}

std::size_t SteadyReport::last_level_with(double level) const {
  std::size_t j = 0;
  while (j + 1 < set_.levels.size() && set_.levels[j + 1] >= level) {
    ++j;
  }
  return j;
}

Interval SteadyReport::bound_at(double level, double bias) const {
  return Interval((Interval(bias) + error_bounds(set_, Interval(level))[2]).upper());
}

}  // namespace veritrack::quadrature
