// The numbers that formulas use.
#pragma once

#include <string>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "certificates/model/language/expression.hpp"

namespace veritrack::certificates::language {

/// A number that formulas use: as written in them, a parameter, or pi.
struct Constant {
  std::string name;  ///< as it stands in a formula
  /// Holds the exact value and `nearest`.
  rigor::Interval value;
  double nearest = 0.0;  ///< computed in double precision, in the order in which it is written
  bool is_literal = false;
};

/// The constants of a model: parameters first, then pi and the literal numbers in the order of their use.
/// Every program that is compiled with them has room for all of them as its first inputs.
using Constants = std::vector<Constant>;

/// A formula and the name that it gives a value to.
struct NamedFormula {
  std::string name;
  Position position;  ///< of the name
  Expression formula;
};

/// The parameters, each of which may use those before it, and all literals and pi of `formulas`. Throws
/// LanguageError. Needs the upward rounding mode.
[[nodiscard]] Constants collect_constants(const std::vector<NamedFormula>& parameters,
                                          const std::vector<const Expression*>& formulas);

}  // namespace veritrack::certificates::language
