#include "analysis/rigor/verdict.hpp"

namespace veritrack::rigor {

std::string_view to_string(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::proved:
      return "proved";
    case Verdict::refuted:
      return "refuted";
    case Verdict::undecided:
      break;
  }
  return "undecided";
}

Verdict decide_less(const Interval& a, const Interval& b) {
  if (certainly_less(a, b)) {
    return Verdict::proved;
  }
  if (certainly_less_equal(b, a)) {
    return Verdict::refuted;
  }
  return Verdict::undecided;
}

Verdict decide_less_equal(const Interval& a, const Interval& b) {
  if (certainly_less_equal(a, b)) {
    return Verdict::proved;
  }
  if (certainly_less(b, a)) {
    return Verdict::refuted;
  }
  return Verdict::undecided;
}

Verdict conjunction(std::initializer_list<Verdict> verdicts) noexcept {
  return conjunction<std::initializer_list<Verdict>>(verdicts);
}

}  // namespace veritrack::rigor
