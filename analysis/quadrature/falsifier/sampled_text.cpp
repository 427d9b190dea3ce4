#include "analysis/quadrature/falsifier/sampled_text.hpp"

#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::quadrature {

void add_sampled(theorems::Derivation& derivation, SampledText text, SampledFormula formula, double value) {
  theorems::add_quantity(
      derivation,
      {text.name, formula.symbol, formula.formula, formula.source, text.words, theorems::Sense::sampled},
      rigor::Interval(value));
}

}  // namespace veritrack::quadrature
