// The KKL observer in certificate.json.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/document/number_json.hpp"

namespace veritrack::certificates {

/// The tables of the design, one member for each.
[[nodiscard]] Json kkl_observer_design_json(const Design& read);

}  // namespace veritrack::certificates
