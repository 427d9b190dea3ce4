// A frequency tracker that is given by its recursion: next state = G(state, samples).
#pragma once

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "trackers/model/straight_line_program.hpp"

namespace veritrack::trackers {

/// The recursion of a tracker. Both programs begin their inputs with the constants of the formulas, whose
/// values the scalar's owner gives (a decimal is rarely a double).
struct Recursion {
  /// Inputs: constants, state, samples. Results: the next state.
  StraightLineProgram step{0};
  /// Inputs: constants, state after the step. Result: the estimated frequency in rad/sample.
  StraightLineProgram frequency{0};
  int constants = 0;
  int states = 0;
  /// 1 (one channel) or 2 (in phase, quadrature).
  int samples = 0;
  /// Whether a state is an angle, known modulo 2 pi only; `states` of them.
  std::vector<bool> is_angle;
};

/// The tracker that this recursion is, over any scalar.
template <typename Scalar>
class ModelTracker {
 public:
  /// `recursion` must outlive the tracker. Throws std::invalid_argument when the sizes do not fit.
  ModelTracker(const Recursion& recursion, const std::vector<Scalar>& constants,
               const std::vector<Scalar>& state)
      : recursion_(&recursion), step_inputs_(constants), next_(state) {
    if (static_cast<int>(constants.size()) != recursion.constants ||
        static_cast<int>(state.size()) != recursion.states) {
      throw std::invalid_argument("wrong number of constants or states of a tracker");
    }
    step_inputs_.insert(step_inputs_.end(), state.begin(), state.end());
    frequency_inputs_ = step_inputs_;
    step_inputs_.resize(step_inputs_.size() + static_cast<std::size_t>(recursion.samples), Scalar(0));
  }

  /// One step with the samples of one instant, `samples` of the recursion in number.
  void step(std::span<const Scalar> samples) {
    if (static_cast<int>(samples.size()) != recursion_->samples) {
      throw std::invalid_argument("wrong number of samples of a tracker");
    }
    std::copy(samples.begin(), samples.end(), step_inputs_.end() - recursion_->samples);
    recursion_->step.run(std::span<const Scalar>(step_inputs_), registers_, std::span<Scalar>(next_));
    std::copy(next_.begin(), next_.end(), step_inputs_.begin() + recursion_->constants);
    std::copy(next_.begin(), next_.end(), frequency_inputs_.begin() + recursion_->constants);
  }

  [[nodiscard]] const std::vector<Scalar>& state() const { return next_; }

  /// The estimated frequency, rad/sample.
  [[nodiscard]] Scalar frequency() {
    Scalar result(0);
    recursion_->frequency.run(std::span<const Scalar>(frequency_inputs_), registers_,
                              std::span<Scalar>(&result, 1));
    return result;
  }

 private:
  const Recursion* recursion_;
  std::vector<Scalar> step_inputs_;
  std::vector<Scalar> frequency_inputs_;
  std::vector<Scalar> registers_;
  std::vector<Scalar> next_;
};

}  // namespace veritrack::trackers
