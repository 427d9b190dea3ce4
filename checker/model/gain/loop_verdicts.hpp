// The requirements of [require] on a linear loop, decided (docs/gain-proof.md, section 7).
#pragma once

#include <string>

#include "checker/document/statement.hpp"
#include "checker/model/gain/gain_network.hpp"
#include "checker/model/model_design.hpp"

namespace veritrack::checker {

/// Whether the claim of this id is about the linear loop alone.
bool is_about_linear_loop(const std::string& id);

/// The verdict on such a claim that the design asks for. `network`: of a loop at rest, with one matrix.
Verdict linear_loop_verdict(const std::string& id, const GainNetwork& network, const ModelDesign& design);

}  // namespace veritrack::checker
