// The parts of certificate.md that only a single-channel tracker has.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// The bias in a sentence, and the number of the paper's statements that are true.
[[nodiscard]] std::string single_channel_remarks(const Certificate& certificate);

/// The sets of the same filter as a recursion, or why there are none.
[[nodiscard]] std::string recursion_section(const Certificate& certificate);

[[nodiscard]] std::string single_channel_design_section(const Certificate& certificate);

/// The bias with its ripple, at the frequencies of the band.
[[nodiscard]] std::string bias_section(const Certificate& certificate);

/// The frozen filter: gains, poles, Jury conditions.
[[nodiscard]] std::string transfer_function_section(const Certificate& certificate);

/// The findings on the paper's propositions: every claim that is not required.
[[nodiscard]] std::string proposition_section(const Certificate& certificate);

/// The coverage of the certificate.
[[nodiscard]] std::string single_channel_coverage_section();

}  // namespace veritrack::certificates
