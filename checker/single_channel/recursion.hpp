// The certificate of the same filter as a recursion (tracker "model"), which is a part of a certificate of
// this tracker.
#pragma once

#include <optional>
#include <string>

#include "checker/document/parts.hpp"
#include "checker/sets/guarantee.hpp"
#include "checker/single_channel/single_channel_design.hpp"

namespace veritrack::checker {

class Recursion {
 public:
  /// Verifies the part "recursion" of the certificate, if there is one, and adds its parts to those of
  /// `result`. Its design has to be that of the same filter, word by word: the equations of the tracker with
  /// the certificate's own q1, q2, r, epsilon, amplitude and noise, at a constant frequency of the band or of
  /// a part of it, started anywhere; and it may require what the certificate's design does.
  Recursion(const Tree& certificate, const SingleChannelDesign& design, bool all_boxes, Verification& result);

  /// Whether a claim is one that only a recursion makes.
  static bool is_of_recursion(const std::string& id) { return id.starts_with("recursion/"); }
  /// Whether a claim says that the recursion decides it.
  static bool decides(const Tree& claim) { return claim.find("by") != nullptr; }
  /// A claim of either kind: the verified sentence of the recursion's certificate. Objects where there is
  /// none that is PROVED.
  [[nodiscard]] Claim check(const Tree& claim, const Guarantee& guarantee, Objections& objections) const;

 private:
  const Tree* part_ = nullptr;  ///< its certificate
  Verification found_;
  bool is_verified_ = false;
};

}  // namespace veritrack::checker
