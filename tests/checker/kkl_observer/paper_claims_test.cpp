// The smallest singular value of the Vandermonde matrix, against Eigen's; for which ell the inverse is exact.
#include "checker/kkl_observer/paper_claims.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/oracles.hpp"

namespace {

using namespace veritrack::checker;

double smallest_singular_value(const std::array<double, 4>& rates) {
  Eigen::Matrix4d v;
  for (Eigen::Index i = 0; i < 4; ++i) {
    const double l = rates[static_cast<std::size_t>(i)];
    v.row(i) << l * l * l, l * l, l, 1.0;
  }
  return std::sqrt(veritrack::oracle::least_eigenvalue(v.transpose() * v));
}

KklDesign design_of(const std::vector<Ball>& rates) {
  KklDesign design;
  design.lambda = rates;
  design.frequency_low = Ball(2.0);
  design.frequency_high = Ball(4.0);
  design.amplitude_low = design.amplitude_high = one;
  return design;
}

std::size_t objections_to(const std::string& quantities, const std::string& conditions,
                          const KklDesign& design, const Ball& ell = one,
                          const std::optional<EllEnclosure>& infimum = std::nullopt) {
  Objections objections;
  check_paper_claims(
      read_json(R"({"quantities": {)" + quantities + R"(}, "conditions": [)" + conditions + "]}"), design,
      ell, infimum, objections);
  return objections.size();
}

std::size_t objections_to_value(double low, double high, const KklDesign& design) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), R"("vandermonde_singular_value": {"lo": "%a", "hi": "%a"})", low,
                high);
  return objections_to(text.data(), "", design);
}

}  // namespace

TEST_CASE("the singular value is enclosed, and nothing beside it") {
  const KklDesign design = design_of({one, two, Ball(3.0), four});
  const double value = smallest_singular_value({1.0, 2.0, 3.0, 4.0});
  CHECK(objections_to_value(0.999999 * value, 1.000001 * value, design) == 0);
  CHECK(objections_to_value(1.000001 * value, 1.00001 * value, design) == 1);
  CHECK(objections_to_value(0.99999 * value, 0.999999 * value, design) == 1);
}

TEST_CASE("rates that are known to a few per cent have all their singular values enclosed") {
  const KklDesign design = design_of({one, two, Ball(3.0), Ball::hull(Ball(3.9), Ball(4.1))});
  const double least = smallest_singular_value({1.0, 2.0, 3.0, 3.9});
  const double most = smallest_singular_value({1.0, 2.0, 3.0, 4.1});
  REQUIRE(least < 0.99 * most);
  CHECK(objections_to_value(0.0, 1e3, design) == 0);
  CHECK(objections_to_value(1.001 * least, 1e3, design) == 1);
  CHECK(objections_to_value(0.0, 0.999 * most, design) == 1);
}

TEST_CASE("equal rates tell too little for an injective map") {
  const std::string claim = R"({"id": "injectivity", "verdict": "proved"})";
  CHECK(objections_to("", claim, design_of({one, two, Ball(3.0), four})) == 0);
  CHECK(objections_to("", claim, design_of({one, two, two, four})) > 0);
}

TEST_CASE("mu vanishes for ell up to twice the infimum, certainly not above it, and in between who knows") {
  const auto is_accepted = [](const char* verdict, double ell) {
    bool all = true;
    for (const std::string id : {"mu-vanishes", "left-inverse"}) {
      all = all && objections_to("", R"({"id": ")" + id + R"(", "verdict": ")" + verdict + R"("})",
                                 design_of({one, two, Ball(3.0), four}), Ball(ell),
                                 EllEnclosure{one, two, Ball(3.0)}) == 0;
    }
    return all;
  };
  for (const auto& [ell, verdict] :
       {std::pair(1.0, "proved"), std::pair(2.0, "proved"), std::pair(2.001, "undecided"),
        std::pair(3.0, "undecided"), std::pair(4.0, "undecided"), std::pair(4.001, "refuted")}) {
    for (const std::string claimed : {"proved", "refuted"}) {
      CAPTURE(ell);
      CAPTURE(claimed);
      CHECK(is_accepted(claimed.c_str(), ell) == (claimed == verdict));
    }
  }
}
