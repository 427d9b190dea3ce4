// The distance of design values from the requirements, and the changes that would be needed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "certificates/tuning/objective.hpp"

namespace veritrack::certificates {

/// The shortfall of the known numbers against [require] and the assumed starts, noise and slew: a sum of
/// logarithms; 0 without a shortfall.
[[nodiscard]] double shortage(const CertifiedValues& found, const Assumptions& assume,
                              const Requirements& require);

/// A sentence for each requirement that is not met, with the number that is certified instead.
[[nodiscard]] std::vector<std::string> unmet_requirements(const CertifiedValues& found,
                                                          const Assumptions& assume,
                                                          const Requirements& require);

/// The certified or estimated numbers of the values under other assumptions and with another leak.
using CertifiedUnder = std::function<CertifiedValues(const Assumptions&, const Number& leak)>;

/// The reduction of noise, slew, walk, start error or leak that would be enough, each by itself, found by
/// certifying the same values with less of it: sentences. For Gaussian noise it is estimated, and the
/// sentences state that.
[[nodiscard]] std::vector<std::string> changes_that_would_do(const CertifiedUnder& certify,
                                                             const Assumptions& assume,
                                                             const Requirements& require, const Number& leak);

}  // namespace veritrack::certificates
