// Bookkeeping of one audited inequality.
#pragma once

#include <string>
#include <utility>

#include "analysis/theorems/audit.hpp"

namespace veritrack::theorems {

/// Collects the evaluations of one inequality, step by step. Needs the upward rounding mode.
class AuditRecord {
 public:
  /// `not_applicable`: the reason why there is no bound; every evaluation is then ignored.
  AuditRecord(AuditedInequality inequality, std::optional<std::string> not_applicable)
      : inequality_(std::move(inequality)) {
    inequality_.not_applicable = std::move(not_applicable);
  }

  /// value <= bound at this step.
  rigor::Verdict at_most(std::size_t step, const rigor::Interval& value, const rigor::Interval& bound) {
    return add(step, bound - value, bound);
  }
  /// value >= bound at this step.
  rigor::Verdict at_least(std::size_t step, const rigor::Interval& value, const rigor::Interval& bound) {
    return add(step, value - bound, bound);
  }
  /// An inequality with the given bound and margin, which is non-negative exactly when the inequality is
  /// satisfied.
  rigor::Verdict add(std::size_t step, const rigor::Interval& margin, const rigor::Interval& bound);

  [[nodiscard]] const AuditedInequality& inequality() const noexcept { return inequality_; }

 private:
  AuditedInequality inequality_;
};

}  // namespace veritrack::theorems
