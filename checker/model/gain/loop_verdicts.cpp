#include "checker/model/gain/loop_verdicts.hpp"

#include <optional>

#include "checker/model/gain/detector_loop.hpp"
#include "checker/model/gain/mode_damping.hpp"
#include "checker/model/gain/stability.hpp"
#include "checker/model/required_claims.hpp"

namespace veritrack::checker {

namespace {

Verdict damping_of_modes(const BallRows& matrix, const Ball& least) {
  const std::optional<std::size_t> damped = modes_damped_more_than(matrix, least);
  return !damped ? Verdict::undecided : *damped == matrix.size() ? Verdict::proved : Verdict::refuted;
}

Verdict time_constant(const BallRows& matrix, const Ball& samples) {
  if (!certainly_positive(samples)) {
    return Verdict::undecided;
  }
  const Ball shrinking = exp(-(one / samples));
  return all_eigenvalues_within(matrix, shrinking) ? Verdict::proved
         : an_eigenvalue_beyond(matrix, shrinking) ? Verdict::refuted
                                                   : Verdict::undecided;
}

Verdict gain_margin(const GainNetwork& network, const Ball& decibels) {
  if (!certainly_positive(decibels)) {
    return Verdict::undecided;
  }
  if (an_eigenvalue_beyond(network.matrix, one)) {
    return Verdict::refuted;  // whatever its detector is
  }
  const std::optional<DetectorLoop> loop = detector_loop(network);
  const Ball factor = exp(decibels / Ball(20.0) * log(Ball(10.0)));
  return !loop                              ? Verdict::undecided
         : is_stable_up_to(*loop, factor)   ? Verdict::proved
         : is_unstable_up_to(*loop, factor) ? Verdict::refuted
                                            : Verdict::undecided;
}

Verdict bandwidth(const GainNetwork& network, const Ball& most) {
  const std::optional<DetectorLoop> loop = detector_loop(network);
  return loop ? decide_less(noise_bandwidth(*loop), most) : Verdict::undecided;
}

}  // namespace

bool is_about_linear_loop(const std::string& id) {
  return id == kDamping || id == kTimeConstant || id == kNoiseBandwidth || id == kGainMargin;
}

Verdict linear_loop_verdict(const std::string& id, const GainNetwork& network, const ModelDesign& design) {
  return id == kDamping          ? damping_of_modes(network.matrix, design.damping->value)
         : id == kTimeConstant   ? time_constant(network.matrix, design.settles_like->value)
         : id == kNoiseBandwidth ? bandwidth(network, design.noise_bandwidth->value)
         : id == kGainMargin     ? gain_margin(network, design.gain_margin->value)
                                 : Verdict::undecided;
}

}  // namespace veritrack::checker
