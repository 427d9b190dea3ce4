// The recursion of a model as text: as formulas, or as code that computes the same.
#pragma once

#include <string>
#include <string_view>

#include "certificates/document/code_language.hpp"
#include "certificates/model/model.hpp"

namespace veritrack::certificates {

/// The step, the frequency and the start of the model. Operations stand in the order in which the model
/// computes them, so that code compiled without contraction (-ffp-contract=off) computes the same doubles.
[[nodiscard]] std::string recursion_text(const Model& model, std::string_view title, CodeLanguage language);

}  // namespace veritrack::certificates
