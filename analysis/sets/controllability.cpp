#include "analysis/sets/controllability.hpp"

#include "analysis/rigor/rounding.hpp"

namespace veritrack::sets {

namespace {

using rigor::Interval;

/// Is every entry certainly, and exactly, zero?
template <typename Derived>
bool is_exactly_zero(const Eigen::MatrixBase<Derived>& matrix) {
  bool zero = matrix.size() > 0;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    const bool this_one = Interval(matrix.derived().coeff(i)) == Interval(0.0);
    zero = zero && this_one;
  }
  return zero;
}

}  // namespace

UncontrollableMode find_uncontrollable_mode(const trackers::ToneModel<Interval>& design) {
  const rigor::UpwardRounding upward;
  const Interval zero(0.0);
  const Interval one(1.0);
  UncontrollableMode mode;
  // (3.8) in the frame that turns with the true phase: Rot(-omega) turns the prediction back.
  mode.transition << one, zero, zero, zero, one, one, zero, zero, one - design.epsilon;
  mode.process_noise << design.q1, zero, zero, zero, design.q1, zero, zero, zero, design.q2;
  mode.left_eigenvector = rigor::Vector<3>(1.0, 0.0, 0.0);
  mode.eigenvalue = 1.0;
  const bool numbers = is_finite(mode.transition) && is_finite(mode.process_noise) && is_finite(design.r);
  const bool without_leak = design.epsilon == zero;
  if (!numbers || !without_leak) {
    // With a leak and omega != 0 the fixed point is biased, where F turns the amplitude into the phase
    // that q2 drives: this witness says nothing there.
    mode.reason =
        numbers ? "with a leak the estimate settles with a bias, where the amplitude is not a separate mode"
                : "a design value is not finite";
    return mode;
  }
  const rigor::IntervalMatrix<1, 3> w = rigor::to_interval(mode.left_eigenvector).transpose();
  const rigor::IntervalMatrix<1, 3> residual = w * mode.transition - w * Interval(mode.eigenvalue);
  const rigor::IntervalMatrix<1, 3> drive = w * mode.process_noise;
  if (!is_exactly_zero(residual) || !is_exactly_zero(drive)) {
    mode.reason = "the process noise q1 drives the amplitude";
    return mode;
  }
  mode.verdict = rigor::Verdict::proved;
  mode.reason =
      "with q1 = 0 and epsilon = 0 no process noise reaches the amplitude, a mode with eigenvalue 1: its "
      "variance and its gain decay like 1/k, and no steady state is exponentially stable; q1 > 0 remedies "
      "this";
  return mode;
}

}  // namespace veritrack::sets
