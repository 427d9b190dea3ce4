// The requirements of a design for a model, and the words for them: the same however its claims are decided.
#pragma once

#include <string>
#include <vector>

#include "checker/document/parts.hpp"
#include "checker/model/model_design.hpp"
#include "checker/sets/frequency_words.hpp"

namespace veritrack::checker {

// The names of claims.
inline const std::string kErrorBound = "model/frequency-error-bound";
inline const std::string kSettlingTime = "model/settling-time";
inline const std::string kLargestNoise = "model/largest-noise";
inline const std::string kLargestSlew = "model/largest-slew";
inline const std::string kRadius = "model/frequency-error-radius";
inline const std::string kBias = "model/bias";
inline const std::string kRipple = "model/ripple";
inline const std::string kDamping = "model/damping";
inline const std::string kTimeConstant = "model/time-constant";
inline const std::string kNoiseBandwidth = "model/noise-bandwidth";
inline const std::string kGainMargin = "model/gain-margin";
inline const std::string kGuarantee = "model/guarantee";
inline const std::string kCapture = "model/capture";
inline const std::string kCaptureTime = "model/capture-time";
inline const std::string kLimits = "model/limits";
inline const std::string kReach = "model/reach";
inline const std::string kSlewLimit = "model/slew-limit";
inline const std::string kSteadyState = "model/steady-state";
inline const std::string kStability = "model/stability";
inline const std::string kLosingLock = "model/probability-of-losing-lock";
inline const std::string kLock = "model/losing-lock";
inline const std::string kLowestSnr = "model/lowest-snr";

/// A decimal that the claim writes: the statement on a value, exactly.
Ball written(const Tree& claim, const char* name);

/// The sentence of kReach, without a verdict.
Claim reach_claim(const Tree& claim, const ModelWords& words, const FrequencyWords& units);

class RequiredClaims {
 public:
  /// `captured_in`: the name of the set that a start is captured in. All must outlive this.
  RequiredClaims(const Tree& certificate, const ModelDesign& design, std::string captured_in);

  /// The requirements of [require].
  [[nodiscard]] std::vector<Requirement> all() const;
  /// The statement of a claim, without its hypotheses.
  [[nodiscard]] std::string short_text(const std::string& id) const;

 private:
  /// The frequency error that the claim of this id names, and `text` with that number; nothing where it names
  /// none.
  [[nodiscard]] const std::string* named_error(const std::string& id) const;
  [[nodiscard]] std::string in_lock(const std::string& id, const std::string& text) const;

  const Tree* claims_;  ///< of the certificate
  const ModelDesign* design_;
  std::string captured_in_;
  ModelWords words_;
  FrequencyWords units_;
};

}  // namespace veritrack::checker
