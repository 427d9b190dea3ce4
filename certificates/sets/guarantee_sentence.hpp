// The guarantee in one sentence, in engineering words: what an engineer may rely on, or what is missing.
#pragma once

#include <optional>
#include <string>

#include "certificates/document/certificate.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// What the guarantee of an extended Kalman filter is about.
struct GuaranteeTerms {
  const Assumptions& assume;
  const Requirements& require;
  bool in_band = false;  ///< only for frequencies of the assumed band
};

/// The claim "ekf/guarantee": with this noise and slew, started within these errors, the frequency error
/// stays below so much for ever. PROVED with the bound that is certified (and the one that is required, when
/// it is met); else the verdict on what is required, and as its reason which hypothesis fails, by how much,
/// and what would repair it. Not a requirement itself. Call after add_required_claims.
[[nodiscard]] Claim guarantee_claim(const Certificate& certificate, const GuaranteeTerms& terms);

/// The top of the document: that claim, and the limits that the design tolerates.
[[nodiscard]] std::string guarantee_section(const Certificate& certificate);

/// The first line of the document when nothing is required but a bound is proved; none otherwise.
[[nodiscard]] std::optional<std::string> proved_bound_headline(const Certificate& certificate);

}  // namespace veritrack::certificates
