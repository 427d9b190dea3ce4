// Starts beyond the certified set, which are followed into it (docs/contraction.md, section 7).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "checker/quadrature/certified_set.hpp"
#include "checker/sets/guarantee.hpp"

namespace veritrack::checker {

/// The findings on a derivation "capture", "capture/noise-free" or "capture/reduced-noise".
struct Captured {
  Ball noise, slew;  ///< the starts were followed under at most these
  Verdict verdict = Verdict::undecided;
  std::vector<Quantity> quantities;
  // As in Promises.
  std::optional<Ball> bound, ultimate, wrong_lock;
  std::optional<Settled> settled;
  std::optional<Ball> set_error;  ///< |frequency error| in the set, at most, rad/sample
  std::string covariance;
};

/// Objects unless the boxes in the evidence cover all assumed starts and every one of them is followed into
/// the certified set, or the start in the evidence is followed into another. When there are very many boxes,
/// only a sample is followed unless `all_boxes`, which proves nothing.
Captured check_capture(const Tree& derivation, const Design& design, const std::vector<CertifiedSet>& sets,
                       bool all_boxes, Objections& objections);

/// The claims "ekf/capture...", from the findings on the verified derivations, by their ids.
bool is_capture_claim(const std::string& id);
Claim check_capture_claim(const Tree& claim, const std::map<std::string, Captured>& captured,
                          const Guarantee& guarantee, Objections& objections);

}  // namespace veritrack::checker
