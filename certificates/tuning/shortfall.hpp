// How far design values are from what is required, and what would have to change.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "certificates/tuning/objective.hpp"

namespace veritrack::certificates {

/// By how much what is known falls short of [require] and of the assumed starts, noise and slew: a sum of
/// logarithms; 0 when it does not.
[[nodiscard]] double shortage(const CertifiedValues& found, const Assumptions& assume,
                              const Requirements& require);

/// A sentence for each requirement that is not met: what is certified in place of it.
[[nodiscard]] std::vector<std::string> unmet_requirements(const CertifiedValues& found,
                                                          const Assumptions& assume,
                                                          const Requirements& require);

/// What is certified of the values, or estimated, under other assumptions and with another leak.
using CertifiedUnder = std::function<CertifiedValues(const Assumptions&, const Number& leak)>;

/// How much less noise, slew, walk, start error or leak would do, each by itself, found by certifying the
/// same values with less of it: sentences. For Gaussian noise by estimating, and the sentences say so.
[[nodiscard]] std::vector<std::string> changes_that_would_do(const CertifiedUnder& certify,
                                                             const Assumptions& assume,
                                                             const Requirements& require, const Number& leak);

}  // namespace veritrack::certificates
