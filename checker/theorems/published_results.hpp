// The published results beside Theorem 2.9, evaluated for the design: closed formulas
// (docs/published-results.md).
#pragma once

#include <functional>
#include <map>
#include <string>

#include "checker/document/design.hpp"

namespace veritrack::checker {

/// Is there a check for this derivation?
bool is_published_result(const std::string& id);

/// Objects to what of the derivation could not be re-established.
void check_published_result(const std::string& id, const Tree& derivation, const Design& design,
                            Objections& objections);

/// A result evaluated for a design, given what the certificate says of it.
using Evaluate = std::function<Derivation(const Design&, const Tree&)>;
/// All results there are, by id.
const std::map<std::string, Evaluate>& model_results();
const std::map<std::string, Evaluate>& error_equation_results();

}  // namespace veritrack::checker
