// The exact results that the self-test expects, computed with rational arithmetic (square roots: with integer
// roots).
#pragma once

#include <limits>
#include <string_view>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/mpfr_reference.hpp"

namespace veritrack::rigor {

/// a operation b ('r': the square root of a), rounded down and up.
struct Pattern {
  char operation;
  double a;
  double b;
  double down;
  double up;
};

inline constexpr double kOverflow = std::numeric_limits<double>::infinity();

inline constexpr Pattern kPatterns[] = {
    {'+', 0x1p+0, 0x1p-60, 0x1p+0, 0x1.0000000000001p+0},
    {'+', -0x1p+0, 0x1p-60, -0x1p+0, -0x1.fffffffffffffp-1},
    {'+', 0x1.999999999999ap-4, 0x1.999999999999ap-3, 0x1.3333333333333p-2, 0x1.3333333333334p-2},
    {'+', 0x1.fffffffffffffp+1023, 0x1.fffffffffffffp+1023, 0x1.fffffffffffffp+1023, kOverflow},
    {'+', 0x0.0000000000001p-1022, 0x0.0000000000001p-1022, 0x0.0000000000002p-1022, 0x0.0000000000002p-1022},
    {'+', 0x1p-1022, -0x0.0000000000001p-1022, 0x0.fffffffffffffp-1022, 0x0.fffffffffffffp-1022},
    {'-', 0x1p+0, 0x1p-60, 0x1.fffffffffffffp-1, 0x1p+0},
    {'-', 0x1.3333333333333p-2, 0x1.999999999999ap-4, 0x1.9999999999999p-3, 0x1.9999999999999p-3},
    {'-', 0x1p-1022, 0x0.0000000000001p-1022, 0x0.fffffffffffffp-1022, 0x0.fffffffffffffp-1022},
    {'-', 0x1p+0, 0x1p+0, 0.0, 0.0},
    {'*', 0x1.999999999999ap-4, 0x1.999999999999ap-4, 0x1.47ae147ae147bp-7, 0x1.47ae147ae147cp-7},
    {'*', -0x1.999999999999ap-4, 0x1.4p+3, -0x1.0000000000001p+0, -0x1p+0},
    {'*', 0x1.0000000000001p+0, 0x1.0000000000001p+0, 0x1.0000000000002p+0, 0x1.0000000000003p+0},
    {'*', 0x0.0000000000001p-1022, 0x1p-1, 0.0, 0x0.0000000000001p-1022},
    {'*', 0x1p-1022, 0x1.3333333333333p-2, 0x0.4ccccccccccccp-1022, 0x0.4cccccccccccdp-1022},
    {'*', 0x1.fffffffffffffp+1023, 0x1p+1, 0x1.fffffffffffffp+1023, kOverflow},
    {'*', 0x1.8p+1, 0x1.4p+2, 0x1.ep+3, 0x1.ep+3},
    {'/', 0x1p+0, 0x1.8p+1, 0x1.5555555555555p-2, 0x1.5555555555556p-2},
    {'/', -0x1p+0, 0x1.8p+1, -0x1.5555555555556p-2, -0x1.5555555555555p-2},
    {'/', 0x1p+0, 0x1.4p+3, 0x1.9999999999999p-4, 0x1.999999999999ap-4},
    {'/', 0x1p+1, 0x1.8p+1, 0x1.5555555555555p-1, 0x1.5555555555556p-1},
    {'/', 0x0.0000000000001p-1022, 0x1.8p+1, 0.0, 0x0.0000000000001p-1022},
    {'/', 0x1p-1022, 0x1.cp+2, 0x0.2492492492492p-1022, 0x0.2492492492493p-1022},
    {'/', 0x1.fffffffffffffp+1023, 0x1p-1, 0x1.fffffffffffffp+1023, kOverflow},
    {'/', 0x1.8p+2, 0x1.8p+1, 0x1p+1, 0x1p+1},
    {'r', 0x1p+1, 0.0, 0x1.6a09e667f3bccp+0, 0x1.6a09e667f3bcdp+0},
    {'r', 0x1.8p+1, 0.0, 0x1.bb67ae8584caap+0, 0x1.bb67ae8584cabp+0},
    {'r', 0x1.999999999999ap-4, 0.0, 0x1.43d136248490fp-2, 0x1.43d136248491p-2},
    {'r', 0x1p+2, 0.0, 0x1p+1, 0x1p+1},
    {'r', 0x0.0000000000001p-1022, 0.0, 0x1p-537, 0x1p-537},
    {'r', 0x0.0000000000002p-1022, 0.0, 0x1.6a09e667f3bccp-537, 0x1.6a09e667f3bcdp-537},
    {'r', 0x1.fffffffffffffp+1023, 0.0, 0x1.fffffffffffffp+511, 0x1p+512},
    {'r', 0x1p-1022, 0.0, 0x1p-511, 0x1p-511},
    {'r', 0x1.0000000000001p+0, 0.0, 0x1p+0, 0x1.0000000000001p+0},
};

/// A function at a double: the two doubles nearest to its value, from its series in rational arithmetic.
struct ElementaryPattern {
  std::string_view name;
  Interval (*function)(const Interval&);
  double (*reference)(double, Direction);
  double argument;
  double down;
  double up;
};

inline constexpr ElementaryPattern kElementaryPatterns[] = {
    {"sin", sin, detail::reference_sin, 1.0, 0x1.aed548f090ceep-1, 0x1.aed548f090cefp-1},
    {"sin", sin, detail::reference_sin, 22.0, -0x1.220a29f6eb9f4p-7, -0x1.220a29f6eb9f3p-7},
    {"cos", cos, detail::reference_cos, 1.0, 0x1.14a280fb5068bp-1, 0x1.14a280fb5068cp-1},
    {"cos", cos, detail::reference_cos, 11.0, 0x1.220ae41ee2fdfp-8, 0x1.220ae41ee2fe0p-8},
    {"exp", exp, detail::reference_exp, 1.0, 0x1.5bf0a8b145769p+1, 0x1.5bf0a8b14576ap+1},
    {"exp", exp, detail::reference_exp, -10.0, 0x1.7cd79b5647c9ap-15, 0x1.7cd79b5647c9bp-15},
    {"atan", atan, detail::reference_atan, 1.0, 0x1.921fb54442d18p-1, 0x1.921fb54442d19p-1},
    {"log", log, detail::reference_log, 2.0, 0x1.62e42fefa39efp-1, 0x1.62e42fefa39f0p-1},
};

}  // namespace veritrack::rigor
