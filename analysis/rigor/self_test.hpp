// The start-up self-test: does this build, on this machine, in this process, compute the way the proofs
// assume?
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace veritrack::rigor {

/// Thrown when the arithmetic of this process is not fit for proofs.
class ArithmeticError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The result of the self-test: a line for each failed check.
struct SelfTestReport {
  std::vector<std::string> failures;
  [[nodiscard]] bool passed() const { return failures.empty(); }
};

/// Checks + - * / and square root in both directions, by themselves and through Interval, against exact bit
/// patterns (normal, subnormal, overflowing); that nothing was folded or reused at compile time across a
/// change of mode; that scopes restore the mode; that the process started, and still runs, rounding to
/// nearest without flushing denormals; that elementary functions give known bits; that NaN, infinite and
/// empty operands certify nothing. Call it outside of every rounding scope, once, before anything is
/// certified. Takes well below a millisecond.
[[nodiscard]] SelfTestReport run_self_test();

/// Throws ArithmeticError, which lists the failures, unless run_self_test passes.
void require_sound_arithmetic();

}  // namespace veritrack::rigor
