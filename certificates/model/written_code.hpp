// The recursion of a model as a function in C, in one format of numbers.
#pragma once

#include <string>
#include <string_view>

#include "certificates/model/model_design.hpp"

namespace veritrack::certificates {

/// A struct of the states, and functions that prepare it, take a sample and report the frequency. Their
/// operations are those of language::written_listing, one for one. `arithmetic`: binary32 or binary64. Throws
/// RequestError for [model.ekf]. Needs the upward rounding mode.
[[nodiscard]] std::string written_code(const ModelTables& tables, std::string_view title,
                                       std::string_view arithmetic);

}  // namespace veritrack::certificates
