// The certificate of a regulator that runs on a frequency tracker.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/document/number_json.hpp"
#include "certificates/regulator/regulator_design.hpp"
#include "certificates/sets/frequency_promise.hpp"

namespace veritrack::certificates {

/// The data that only this kind has.
struct RegulatorParticulars {
  Certificate tracker;       ///< of the frequency tracker, as it would be alone
  FrequencyPromise promise;  ///< its bounds on the frequency error
};

/// The data of a certificate of this kind. Throws std::bad_any_cast for another.
[[nodiscard]] const RegulatorParticulars& regulator_particulars(const Certificate& certificate);

/// Certifies the frequency tracker, adds the derivation "regulator", the claims and their verdict. Needs the
/// upward mode.
void certify_regulator(Certificate& certificate, const CertifyProgress& progress);

/// The members of certificate.json: the design, and the tracker's certificate.
[[nodiscard]] Json regulator_design_json(const Design& design);
[[nodiscard]] Json regulator_evidence_json(const Certificate& certificate);

/// "1 - 0.5 q^-1": a polynomial in the delay, from its coefficients as they are written; `first` is the
/// constant.
[[nodiscard]] std::string delay_polynomial(const std::string& first, const std::vector<Number>& rest,
                                           std::size_t skipped = 0);

}  // namespace veritrack::certificates
