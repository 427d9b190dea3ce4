// The claims of the KKL observer's paper, decided for a design: the derivation "kkl-paper".
#pragma once

#include "checker/kkl_observer/kkl_ell.hpp"

namespace veritrack::checker {

/// `ell` is the one in use in (9). `infimum` is that of (10), once verified; without it nothing is decided
/// about mu of (9).
void check_paper_claims(const Tree& derivation, const KklDesign& design, const Ball& ell,
                        const std::optional<EllEnclosure>& infimum, Objections& objections);

}  // namespace veritrack::checker
