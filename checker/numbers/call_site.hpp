// The place of a comparison: only in the build that searches for guards whose absence no test notices
// (-DVERITRACK_MUTATION=ON, scripts/mutation). There a comparison is true at the one place that
// VERITRACK_MUTANT=file:line:column names, whatever it compares, and VERITRACK_MUTANT_SITES names a file to
// which each place that is reached is written. In all other builds these macros are empty.
#pragma once

#ifdef VERITRACK_MUTATION

#include <source_location>

namespace veritrack::checker {
/// True at the place that the environment names.
[[nodiscard]] bool forced(const std::source_location& place);
}  // namespace veritrack::checker

// NOLINTBEGIN(cppcoreguidelines-macro-usage): parameters that are there or not
/// The only parameter, or the last one, where it is declared and where it is only defined.
#define CHECKER_SOLE_PLACE const std::source_location& place = std::source_location::current()
#define CHECKER_PLACE , CHECKER_SOLE_PLACE
#define CHECKER_DECLARED_PLACE , const std::source_location& place
#define CHECKER_IF_FORCED                    \
  if (::veritrack::checker::forced(place)) { \
    return true;                             \
  }
// NOLINTEND(cppcoreguidelines-macro-usage)

#else

#define CHECKER_SOLE_PLACE
#define CHECKER_PLACE
#define CHECKER_DECLARED_PLACE
#define CHECKER_IF_FORCED

#endif
