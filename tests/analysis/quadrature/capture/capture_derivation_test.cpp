// The condition on the set that starts are captured by.
#include "analysis/quadrature/capture/capture_derivation.hpp"

#include <doctest/doctest.h>

#include "analysis/rigor/rounding.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;

TEST_CASE("a set captures under no more noise and slew than it tolerates") {
  const rigor::UpwardRounding upward;
  quadrature::CertifiedSet set;
  set.noise = 0.5;
  set.slew = 0.25;
  const auto verdict = [&](const Interval& noise, const Interval& slew) {
    sets::ContractionQuestion question;
    question.noise = noise;
    question.slew = slew;
    return quadrature::set_tolerates_assumptions(question, set).verdict;
  };
  CHECK(verdict(Interval(0.5), Interval(0.25)) == Verdict::proved);
  CHECK(verdict(Interval::from_bounds(0.5, 0.51), Interval(0.0)) == Verdict::undecided);
  CHECK(verdict(Interval(0.0), Interval::from_bounds(0.25, 0.26)) == Verdict::undecided);
}

}  // namespace
