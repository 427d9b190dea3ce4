// A filter is certified by its structure; where that leaves a requirement open, or proves nothing, it is
// certified with its covariance among the states.
#pragma once

#include <functional>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// The certificate by structure, or the one without structure if it proves more of the requirements, or
/// something where the first one proves nothing. The second one is tried only where the first one bounds a
/// covariance and does not prove all, or proves nothing, before the deadline.
[[nodiscard]] Certificate better_way(const std::function<Certificate(bool by_structure)>& certify);

}  // namespace veritrack::certificates
