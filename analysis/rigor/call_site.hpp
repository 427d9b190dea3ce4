// Where a predicate is called from: in mutation builds only (-DVERITRACK_MUTATION=ON), where a predicate
// returns true at the one call that the environment names, to see whether a test notices (scripts/mutation).
// In all other builds the macros are empty.
//
// VERITRACK_MUTANT=file:line:column names the call, VERITRACK_MUTANT_SITES a file to which each call that is
// reached is appended once, in that form.
#pragma once

#ifdef VERITRACK_MUTATION

#include <source_location>

namespace veritrack::rigor::detail {
/// True at the call that the environment names.
[[nodiscard]] bool is_mutant(const std::source_location& call_site);
}  // namespace veritrack::rigor::detail

// NOLINTBEGIN(cppcoreguidelines-macro-usage): parameters that are there or not
/// The last parameter of a predicate where it is declared, and where it is only defined.
#define VERITRACK_CALL_SITE , const std::source_location& call_site = std::source_location::current()
#define VERITRACK_DECLARED_CALL_SITE , const std::source_location& call_site
/// Hands the call on to a predicate that answers for this one.
#define VERITRACK_SAME_CALL_SITE , call_site
/// The beginning of every predicate.
#define VERITRACK_MUTANT_RETURNS(value)                   \
  if (::veritrack::rigor::detail::is_mutant(call_site)) { \
    return value;                                         \
  }
// NOLINTEND(cppcoreguidelines-macro-usage)

#else

#define VERITRACK_CALL_SITE
#define VERITRACK_DECLARED_CALL_SITE
#define VERITRACK_SAME_CALL_SITE
#define VERITRACK_MUTANT_RETURNS(value)

#endif
