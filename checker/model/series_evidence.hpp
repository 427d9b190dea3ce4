// Numbers and series as evidence on curves writes them. Any numbers are valid.
#pragma once

#include <vector>

#include "checker/document/json_tree.hpp"
#include "checker/model/tube_evidence.hpp"

namespace veritrack::checker {

/// A number that is a double. Throws std::invalid_argument for another.
double double_from(const Tree& number);
std::vector<double> doubles_from(const Tree& list);
/// A list of series. Throws Malformed for one of too many terms.
std::vector<PhaseSeries> series_from(const Tree& list);

}  // namespace veritrack::checker
