// A filter is certified by its structure; where that leaves a requirement open, with its covariance among the states.
#pragma once

#include <functional>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// The certificate by structure, or the one without if it proves more of what is required. That one is tried only
/// where the first one bounds a covariance and does not prove all, before the deadline.
[[nodiscard]] Certificate better_way(const std::function<Certificate(bool by_structure)>& certify);

}  // namespace veritrack::certificates
