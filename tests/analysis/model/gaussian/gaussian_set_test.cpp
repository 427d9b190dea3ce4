#include "analysis/model/gaussian/gaussian_set.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {
namespace {

TEST_CASE("noise that is often longer than its bound, and a drift that does not shrink, bound nothing") {
  const rigor::UpwardRounding upward;
  const rigor::Interval samples(10.0);
  const GaussianTerms terms{
      .deviation = 1.0, .most_noise = 9.0, .exponent = 50.0, .factor = 0.5, .constant = 0.01};
  CHECK(leaving_probability(terms, 1, samples, 0.0) < 1e-3);
  GaussianTerms loud = terms;
  for (const double noise : {0.0, 0.1, 0.5, 1.0}) {
    loud.most_noise = noise;
    CHECK(leaving_probability(loud, 1, samples, 0.0) >= 1.0);
  }
  GaussianTerms growing = terms;
  for (const double factor : {1.0, 1.1, double{NAN}}) {
    growing.factor = factor;
    CHECK(std::isinf(leaving_probability(growing, 1, samples, 0.0)));
  }
}

}  // namespace
}  // namespace veritrack::model
