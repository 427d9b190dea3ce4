// The part of certificate.md that shows this program's own proofs for the design.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Conditions, the certified set in engineering units, its coverage, and the starts beyond it that were
/// followed.
[[nodiscard]] std::string contraction_section(const Certificate& certificate);

}  // namespace veritrack::certificates
