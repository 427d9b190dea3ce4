// Numbers in sentences: decimals of a few digits, rounded in the direction that keeps the sentence true.
#pragma once

#include <string>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

constexpr int kDigitsInSentences = 3;

/// The least decimal of this many significant digits that is not below any point of the ball, and the
/// greatest that is not above any; "inf" and "-inf" where there is none. Plain from 1e-5 to 1e10, else as
/// 1.5e-7.
std::string upper_decimal(const Ball& value, int digits = kDigitsInSentences);
std::string lower_decimal(const Ball& value, int digits = kDigitsInSentences);

}  // namespace veritrack::checker
