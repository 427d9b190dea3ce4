// One table for the reader: the certified numbers of each result for the design, and the same from
// simulation.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Fills certificate.comparison from the derivations and a simulation: a row for each derivation that bounds
/// a start error, a noise or a rate, and for each reading of Theorem 2.9. Call after all derivations are
/// there.
void add_comparison(Certificate& certificate);

enum class ComparedResults {
  of_the_theorem,  ///< the readings of Theorem 2.9, contraction, and the simulation
  all
};

/// The table. Empty when there is nothing to compare.
[[nodiscard]] std::string comparison_section(const Certificate& certificate, ComparedResults which);

}  // namespace veritrack::certificates
