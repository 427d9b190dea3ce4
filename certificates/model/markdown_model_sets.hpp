// The sections of a model's certificate on its sets, and on bias and ripple.
#pragma once

#include <string>
#include <string_view>

#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/model/model.hpp"

namespace veritrack::certificates {

/// The figure of this file name with its caption; empty where there is none.
[[nodiscard]] std::string model_picture(const MarkdownOptions& options, std::string_view file);

/// Both need the upward rounding mode, which the attack leaves while it runs.
[[nodiscard]] std::string model_sets_section(const Certificate& certificate, const Model& model,
                                             const MarkdownOptions& options);
[[nodiscard]] std::string model_bias_section(const Certificate& certificate, const MarkdownOptions& options);

}  // namespace veritrack::certificates
