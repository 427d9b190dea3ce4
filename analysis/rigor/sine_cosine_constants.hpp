// The constants of sine_cosine.cpp and quarter_turns.cpp. An error in the last place would be hidden by later
// roundings, so that no test of sin and cos could detect it. Therefore a test compares each constant with
// MPFR instead.
#pragma once

#include <array>

namespace veritrack::rigor::detail {

/// Bounds on one real number.
struct Bounds {
  double low;
  double high;
};

/// 2/pi
inline constexpr Bounds kTwoOverPi{0x1.45f306dc9c882p-1, 0x1.45f306dc9c883p-1};

/// pi/2 is the sum of the three; the first two have 33 bits.
inline constexpr double kHalfPi1 = 0x1.921fb544p+0;
inline constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
inline constexpr Bounds kHalfPi3{0x1.3198a2e037073p-69, 0x1.3198a2e037074p-69};

inline constexpr int kTerms = 9;
using Coefficients = std::array<Bounds, kTerms>;

/// 1/3!, 1/5!, ..., 1/19!
inline constexpr Coefficients kSineCoefficients{{{0x1.5555555555555p-3, 0x1.5555555555556p-3},
                                                 {0x1.1111111111111p-7, 0x1.1111111111112p-7},
                                                 {0x1.a01a01a01a01ap-13, 0x1.a01a01a01a01bp-13},
                                                 {0x1.71de3a556c733p-19, 0x1.71de3a556c734p-19},
                                                 {0x1.ae64567f544e3p-26, 0x1.ae64567f544e4p-26},
                                                 {0x1.6124613a86d09p-33, 0x1.6124613a86d0ap-33},
                                                 {0x1.ae7f3e733b81fp-41, 0x1.ae7f3e733b820p-41},
                                                 {0x1.952c77030ad4ap-49, 0x1.952c77030ad4bp-49},
                                                 {0x1.2f49b46814157p-57, 0x1.2f49b46814158p-57}}};

/// 1/2!, 1/4!, ..., 1/18!
inline constexpr Coefficients kCosineCoefficients{{{0x1p-1, 0x1p-1},
                                                   {0x1.5555555555555p-5, 0x1.5555555555556p-5},
                                                   {0x1.6c16c16c16c16p-10, 0x1.6c16c16c16c17p-10},
                                                   {0x1.a01a01a01a01ap-16, 0x1.a01a01a01a01bp-16},
                                                   {0x1.27e4fb7789f5cp-22, 0x1.27e4fb7789f5dp-22},
                                                   {0x1.1eed8eff8d897p-29, 0x1.1eed8eff8d898p-29},
                                                   {0x1.93974a8c07c9dp-37, 0x1.93974a8c07c9ep-37},
                                                   {0x1.ae7f3e733b81fp-45, 0x1.ae7f3e733b820p-45},
                                                   {0x1.6827863b97d97p-53, 0x1.6827863b97d98p-53}}};

}  // namespace veritrack::rigor::detail
