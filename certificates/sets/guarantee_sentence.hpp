// The guarantee in one sentence, in engineering words: what an engineer may rely on, or what is missing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// The subject of a statement: the recursion over the reals, or the program (docs/rounding.md).
inline constexpr std::string_view kExactArithmetic = "In exact arithmetic";
inline constexpr std::string_view kDoublePrecision =
    "In double precision (IEEE 754, rounding to nearest, sine and cosine within one unit in the last place)";

/// The subject of the guarantee of an extended Kalman filter.
struct GuaranteeTerms {
  const Assumptions& assume;
  const Requirements& require;
  bool in_band = false;      ///< only for frequencies of the assumed band
  bool two_channels = true;  ///< the noise is a vector in the plane
  std::string covariance;    ///< "and with P(0|0) ...": the start covariances
  std::string_view arithmetic = kExactArithmetic;
};

/// "In exact arithmetic, for a tone of constant amplitude 1 ...", with the assumed noise and slew if
/// `disturbed`.
[[nodiscard]] std::string tone(const GuaranteeTerms& terms, bool disturbed);

/// "3.14 rad/sample": less than half of the distance from the lock to the next one that the formulas show.
/// One channel also shows a tone of the frequency w as one of -w or 2 pi - w.
[[nodiscard]] std::string lock_words(const GuaranteeTerms& terms);
/// Whether frequency errors up to that bound, rad/sample, are certainly below it. Holds its own rounding
/// mode.
[[nodiscard]] bool is_lock(const rigor::Interval& frequency_error, const GuaranteeTerms& terms);

/// " and is constant, with measurement noise of at most ...": the assumed noise and slew, or those relative
/// to the amplitude and in rad/sample per sample, as decimals; none where they are empty.
[[nodiscard]] std::string assumed_disturbance(const GuaranteeTerms& terms);
[[nodiscard]] std::string disturbance_of(const std::string& noise, const std::string& slew);

/// The tone, with the given words on noise and slew, "..., started within ..., ": all hypotheses of a
/// guarantee.
[[nodiscard]] std::string hypotheses(const GuaranteeTerms& terms, const std::string& disturbance);
/// With the assumed ones.
[[nodiscard]] std::string hypotheses(const GuaranteeTerms& terms);

/// The claim "ekf/guarantee": with this noise and slew, started within these errors, the frequency error
/// stays below a bound for ever. PROVED with the certified bound (and the required one, when it is met);
/// otherwise the verdict on the requirement, and as its reason the hypothesis that fails, by how much, and
/// what would repair it. Not a requirement itself. Call after add_required_claims.
[[nodiscard]] Claim guarantee_claim(const Certificate& certificate, const GuaranteeTerms& terms);

/// The claims that do not depend on the start: the size of the invariant set ("ekf/invariant-set"), and the
/// noise and slew that the design tolerates ("ekf/limits"); those of the two that are proved.
[[nodiscard]] std::vector<Claim> set_claims(const Certificate& certificate, const GuaranteeTerms& terms);

/// Those claims of the certificate, and that on the lowest signal-to-noise ratio.
[[nodiscard]] std::vector<const Claim*> guarantees(const Certificate& certificate);

}  // namespace veritrack::certificates
