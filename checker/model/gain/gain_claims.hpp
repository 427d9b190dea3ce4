// The claims of a certificate for a model, decided from gains (docs/gain-proof.md, sections 5 and 6).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "checker/document/parts.hpp"
#include "checker/model/gain/gain_network.hpp"
#include "checker/model/gain/loop_bounds.hpp"
#include "checker/model/model_design.hpp"
#include "checker/model/required_claims.hpp"
#include "checker/model/tube_step.hpp"
#include "checker/sets/frequency_words.hpp"

namespace veritrack::checker {

class GainClaims {
 public:
  /// Decides the claims of a certificate with this design. `loop`: none where it could not be verified.
  /// `network`: none where the errors have no linear recursion that is the same at all phases. All must
  /// outlive this.
  GainClaims(const Tree& certificate, const ModelDesign& design, const TrackedModel& model,
             const LoopBounds* loop, const GainNetwork* network);

  /// The requirements of [require].
  [[nodiscard]] std::vector<Requirement> required() const { return required_.all(); }
  /// The claim in the checker's words, with its verdict. Objects where the certificate says something else.
  Claim check(const Tree& claim, Objections& objections) const;

 private:
  using Errors = std::unique_ptr<FrequencyErrors>;

  /// Bounds from the steady state; nothing where they are not certain.
  [[nodiscard]] Errors errors(const Ball& noise, const Ball& slew) const;
  /// With all that is assumed.
  [[nodiscard]] Errors assumed_errors() const;
  /// From all starts in which the one state that the frequency is a multiple of has frequency errors up to
  /// `reach`, at every phase.
  [[nodiscard]] Errors errors_from(const Ball& reach, const Ball& noise, const Ball& slew) const;
  /// They stay at or below this, which is nearer to the true lock than to any other that the formulas show
  /// (false_lock.hpp).
  [[nodiscard]] bool is_lock(const Errors& errors, const Ball& error) const;
  /// The frequency error in the long run, without noise, from the steady state.
  [[nodiscard]] bool mean_is_between(const Ball& low, const Ball& high) const;
  [[nodiscard]] bool varies_by_at_most(const Ball& most) const;
  /// To first order the linear recursion is the same at every sample, about a steady state of the true
  /// frequency.
  [[nodiscard]] bool has_one_linear_loop() const;
  [[nodiscard]] std::string assumed_hypotheses() const;
  [[nodiscard]] std::string settled_hypotheses() const;

  [[nodiscard]] Claim required_claim(const Tree& claim) const;
  [[nodiscard]] Claim guarantee(const Tree& claim) const;
  [[nodiscard]] Claim limits(const Tree& claim) const;
  [[nodiscard]] Claim reach(const Tree& claim) const;
  [[nodiscard]] Claim slew_limit(const Tree& claim) const;
  [[nodiscard]] Claim steady_state(const Tree& claim) const;
  [[nodiscard]] Claim stability(const Tree& claim) const;

  const Tree* tree_;  ///< the design
  const ModelDesign* design_;
  const LoopBounds* loop_;
  const GainNetwork* network_;
  Ball half_distance_;      ///< to a false lock
  ModelWords exact_words_;  ///< of what is true to first order
  ModelWords words_;        ///< of the program, where its rounding is known
  RequiredClaims required_;
  FrequencyWords units_;
};

}  // namespace veritrack::checker
