// The certified numbers of tuned values in Gaussian noise, where the search had estimates only.
#pragma once

#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Sentences: the lowest ratio and the root mean square that are certified; none for another noise.
[[nodiscard]] std::vector<std::string> certified_in_gaussian_noise(const Certificate& certificate);

}  // namespace veritrack::certificates
