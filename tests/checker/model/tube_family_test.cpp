#include "checker/model/tube_family.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace veritrack::checker {
namespace {

TubeSet of_part(double low, double high) {
  TubeSet set;
  set.amplitudes = AmplitudePart{low, high};
  return set;
}

bool are_same(const std::vector<TubeSet>& sets, const std::vector<TubeSet>& others) {
  Objections objections;
  check_same_parts(sets, others, objections);
  return objections.empty();
}

TEST_CASE("the families of an inner and an outer set are for the same parts, one by one") {
  const std::vector<TubeSet> parts{of_part(0.5, 1.0), of_part(1.0, 2.0)};
  CHECK(are_same(parts, parts));
  CHECK(are_same({TubeSet{}}, {TubeSet{}}));
  CHECK_FALSE(are_same({}, {}));
  CHECK_FALSE(are_same(parts, {parts[0]}));
  CHECK_FALSE(are_same(parts, {parts[1], parts[0]}));
  CHECK_FALSE(are_same(parts, {of_part(0.5, 1.0), of_part(1.0, 1.9)}));
  CHECK_FALSE(are_same(parts, {of_part(0.6, 1.0), of_part(1.0, 2.0)}));
  CHECK_FALSE(are_same({of_part(0.5, 1.0)}, {TubeSet{}}));
}

TEST_CASE("parts go from low amplitudes to high ones without gaps, over those of the design") {
  ModelDesign design;
  design.is_constant_in_range = true;
  design.least_amplitude = Ball(0.5);
  design.largest_amplitude = Ball(2.0);
  const auto objects = [&](const std::vector<TubeSet>& sets) {
    Objections objections;
    check_amplitudes(sets, design, objections);
    return !objections.empty();
  };
  CHECK_FALSE(objects({of_part(0.5, 1.0), of_part(1.0, 2.0)}));
  CHECK_FALSE(objects({of_part(0.4, 1.1), of_part(1.0, 2.5)}));
  CHECK(objects({}));
  CHECK(objects({TubeSet{}}));
  CHECK(objects({of_part(0.6, 1.0), of_part(1.0, 2.0)}));
  CHECK(objects({of_part(0.5, 1.0), of_part(1.0, 1.9)}));
  CHECK(objects({of_part(0.5, 1.0), of_part(1.1, 2.0)}));
  CHECK(objects({of_part(1.0, 2.0), of_part(0.5, 1.0)}));
  design.is_constant_in_range = false;
  CHECK_FALSE(objects({TubeSet{}}));
  CHECK(objects({TubeSet{}, TubeSet{}}));
}

}  // namespace
}  // namespace veritrack::checker
