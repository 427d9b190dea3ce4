// Names and words for the numbers that the falsifier finds, the same for every kind of set.
#pragma once

#include "analysis/statements/derivation.hpp"

namespace veritrack::quadrature {

/// Name and words of a sampled quantity.
struct SampledText {
  const char* name;
  const char* words;
};

inline constexpr SampledText kRadiusLimit{
    "frequency_error_radius_sampled_limit",
    "frequency error at which a search finds a step out of the set, rad/sample"};
inline constexpr SampledText kShareOfLimit{"frequency_error_radius_share_of_limit",
                                           "certified radius over the radius at which the search succeeds"};
inline constexpr SampledText kBoundTightness{
    "frequency_error_bound_tightness",
    "largest frequency error found from the boundary of its set, over the bound"};
inline constexpr SampledText kUltimateTightness{
    "ultimate_frequency_error_tightness", "largest frequency error found from zero error, over the bound"};

/// Symbol, formula and where it stands.
struct SampledFormula {
  const char* symbol;
  const char* formula;
  const char* source;
};

/// Appends a number that a search found, marked as not proved.
void add_sampled(theorems::Derivation& derivation, SampledText text, SampledFormula formula, double value);

}  // namespace veritrack::quadrature
