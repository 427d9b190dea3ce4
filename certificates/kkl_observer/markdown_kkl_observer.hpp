// The documents of a KKL observer.
#pragma once

#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"

namespace veritrack::certificates {

/// The claims of [require] that are decided.
[[nodiscard]] std::vector<const Claim*> kkl_observer_answers(const Certificate& certificate);

/// Design, assumptions, the certified statements, figures and coverage.
[[nodiscard]] std::string kkl_observer_sections(const Certificate& certificate,
                                                const MarkdownOptions& options);

/// The paper's claims and its simulations.
[[nodiscard]] std::string kkl_observer_published(const Certificate& certificate);

}  // namespace veritrack::certificates
