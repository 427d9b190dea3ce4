#include "analysis/theorems/audit_record.hpp"

namespace veritrack::theorems {

using rigor::Interval;
using rigor::Verdict;

Verdict AuditRecord::add(std::size_t step, const Interval& margin, const Interval& bound) {
  AuditedInequality& record = inequality_;
  if (record.not_applicable) {
    return Verdict::undecided;
  }
  // The sign of a difference is exact under downward rounding: it is non-negative exactly when the difference
  // is.
  const Verdict verdict = decide_less_equal(Interval(0.0), margin);
  const AuditPoint point{step, verdict, margin, margin / abs(bound)};
  if (step < record.first_step) {
    record.before_first_step = point;
    return verdict;
  }
  switch (verdict) {
    case Verdict::proved:
      ++record.satisfied;
      break;
    case Verdict::refuted:
      ++record.violated;
      if (!record.first_violation) {
        record.first_violation = step;
      }
      break;
    case Verdict::undecided:
      ++record.undecided;
      break;
  }
  const bool is_worse = is_finite(margin) && (!record.worst || margin.lower() < record.worst->margin.lower());
  if (is_worse) {
    record.worst = point;
  }
  return verdict;
}

}  // namespace veritrack::theorems
