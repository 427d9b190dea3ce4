// The sections of a model's certificate on its sets, and on bias and ripple.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/model/model.hpp"

namespace veritrack::certificates {

/// Both need the upward rounding mode, which the attack leaves for its time.
[[nodiscard]] std::string model_sets_section(const Certificate& certificate, const Model& model,
                                             const MarkdownOptions& options);
[[nodiscard]] std::string model_bias_section(const Certificate& certificate, const MarkdownOptions& options);

}  // namespace veritrack::certificates
