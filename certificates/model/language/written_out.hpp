// Functions that stand for a formula of others.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/model/language/expression.hpp"

namespace veritrack::certificates::language {

/// Their names: hypot, tanh, wrap.
[[nodiscard]] const std::vector<std::string>& written_out_functions();

/// The number of their arguments; 0 for other functions.
[[nodiscard]] std::size_t arguments_of_written_out(std::string_view name);

/// hypot(x, y) is sqrt(x^2 + y^2), tanh(x) is 1 - 2/(exp(2*x) + 1), and wrap(x) is atan2(sin(x), cos(x)), an
/// angle from -pi to pi. Empty for other functions. Throws LanguageError for another number of arguments, or
/// for so many of them one inside the other that the formula becomes too long.
[[nodiscard]] std::optional<Expression> written_out(std::string_view name, Position position,
                                                    const std::vector<Expression>& arguments);

/// theta' = wrap(formula) becomes theta' = formula, where theta is one of the angles, which are known up to
/// whole turns only, and no formula uses theta'.
void leave_out_outer_wraps(std::vector<Definition>& step, const std::vector<std::string>& angles);

}  // namespace veritrack::certificates::language
