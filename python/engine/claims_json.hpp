// The claims of a certificate as the package for Python reads them.
#pragma once

#include <vector>

#include "certificates/document/certificate.hpp"
#include "python/engine/answers.hpp"

namespace veritrack::python {

/// A list with a member for each claim: its sentence, its verdict, and "quantities", the numbers of its
/// evidence by name, with both ends as hexadecimal floats and the side that is proved.
[[nodiscard]] Json claims_json(const std::vector<certificates::Claim>& all);

}  // namespace veritrack::python
