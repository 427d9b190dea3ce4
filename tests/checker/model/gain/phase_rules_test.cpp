// Remainders of the rules against the functions themselves, at drawn points.
#include "checker/model/gain/phase_rules.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "checker/model/gain/exact_number.hpp"
#include "checker/model/gain/phase_structure.hpp"
#include "tests/checker/model/gain/gain_loops.hpp"

namespace veritrack::checker {
namespace {

struct Rule {
  PhaseOperation operation;
  std::function<double(double)> value, slope;
  double middle;
};

/// The largest share of the remainder's bound that is reached, over a cell around `middle`.
double largest_share(const Rule& rule, double deviation) {
  constexpr double kHalfCell = 0.05;
  const PhaseNode node{rule.operation, 0, 0, {}, {}};
  const BallPolynomial base = BallPolynomial::affine(rule.middle, kHalfCell, 0.0, 0.0);
  const RuleResult result = base_of(node, base, {});
  const double bound = remainder_size(node, result.range, deviation, 0.0);
  REQUIRE(std::isfinite(bound));
  std::mt19937 random(7);
  double share = 0.0;
  for (int trial = 0; trial < 500; ++trial) {
    const double at = rule.middle + kHalfCell * std::uniform_real_distribution<>(-1.0, 1.0)(random);
    const double by = trial % 2 == 0 ? (trial % 4 == 0 ? deviation : -deviation)
                                     : deviation * std::uniform_real_distribution<>(-1.0, 1.0)(random);
    const double remainder = rule.value(at + by) - rule.value(at) - rule.slope(at) * by;
    share = std::max(share, (std::abs(remainder) - 1e-14) / bound);
  }
  return share;
}

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all = {
      {PhaseOperation::reciprocal, [](double x) { return 1 / x; }, [](double x) { return -1 / (x * x); },
       1.3},
      {PhaseOperation::reciprocal, [](double x) { return 1 / x; }, [](double x) { return -1 / (x * x); },
       -1.3},
      {PhaseOperation::sine, [](double x) { return std::sin(x); }, [](double x) { return std::cos(x); }, 0.8},
      {PhaseOperation::cosine, [](double x) { return std::cos(x); }, [](double x) { return -std::sin(x); },
       2.0},
      {PhaseOperation::root, [](double x) { return std::sqrt(x); },
       [](double x) { return 0.5 / std::sqrt(x); }, 2.0},
      {PhaseOperation::exponential, [](double x) { return std::exp(x); },
       [](double x) { return std::exp(x); }, -0.5},
      {PhaseOperation::logarithm, [](double x) { return std::log(x); }, [](double x) { return 1 / x; }, 1.5},
      {PhaseOperation::tangent, [](double x) { return std::tan(x); },
       [](double x) { return 1 + std::tan(x) * std::tan(x); }, 0.3},
      {PhaseOperation::arcsine, [](double x) { return std::asin(x); },
       [](double x) { return 1 / std::sqrt(1 - x * x); }, 0.2},
      {PhaseOperation::arccosine, [](double x) { return std::acos(x); },
       [](double x) { return -1 / std::sqrt(1 - x * x); }, 0.2},
      {PhaseOperation::arctangent, [](double x) { return std::atan(x); },
       [](double x) { return 1 / (1 + x * x); }, 0.6}};
  return all;
}

}  // namespace

TEST_CASE("The remainder of a rule is at most its bound, and comes near it") {
  for (const Rule& rule : rules()) {
    CAPTURE(static_cast<int>(rule.operation));
    for (const double deviation : {1e-3, 0.1, 0.4}) {
      CHECK(largest_share(rule, deviation) <= 1.0);
    }
    CHECK(largest_share(rule, 1e-3) > 0.5);
  }
  for (const double deviation : {1.0, 3.0, 6.0, 50.0}) {
    CHECK(largest_share(rules()[2], deviation) <= 1.0);
    CHECK(largest_share(rules()[3], deviation) <= 1.0);
  }
}

TEST_CASE("The remainder of an angle is at most its bound, off the cut") {
  const PhaseNode node{PhaseOperation::arctangent2, 0, 0, {}, {}};
  std::mt19937 random(3);
  std::uniform_real_distribution<> unit(-1.0, 1.0);
  double share = 0.0;
  for (const double angle : {0.0, 1.0, 2.0, 3.0, -1.5, -2.6}) {
    const double y = 1.5 * std::sin(angle);
    const double x = 1.5 * std::cos(angle);
    const RuleResult result = base_of(node, BallPolynomial(y), BallPolynomial(x));
    for (int trial = 0; trial < 400; ++trial) {
      const double most = angle == 3.0 ? 0.2 : 0.6;
      const double dy = most * unit(random);
      const double dx = most * unit(random);
      const double bound = remainder_size(node, result.range, std::abs(dy), std::abs(dx));
      const double linear = (x * dy - y * dx) / (x * x + y * y);
      const double remainder = std::atan2(y + dy, x + dx) - std::atan2(y, x) - linear;
      share = std::max(share, (std::abs(remainder) - 1e-14) / bound);
    }
  }
  CHECK(share <= 1.0);
  CHECK(share > 0.5);
  const RuleResult behind = base_of(node, BallPolynomial(0.1), BallPolynomial(-1.0));
  CHECK(std::isfinite(remainder_size(node, behind.range, 0.05, 0.05)));
  CHECK(std::isinf(remainder_size(node, behind.range, 0.11, 0.05)));
}

TEST_CASE("The remainder of the larger one is at most its bound, and comes near it") {
  const PhaseNode node{PhaseOperation::larger, 0, 0, {}, {}};
  std::mt19937 random(11);
  std::uniform_real_distribution<> unit(-1.0, 1.0);
  double share = 0.0;
  for (int trial = 0; trial < 4000; ++trial) {
    const double x = trial % 8 == 0 ? 0.5 : unit(random);
    const double y = trial % 8 == 0 ? 0.5 : unit(random);
    const double of_x = 0.5 * (1.0 + unit(random));
    const double of_y = trial % 3 == 0 ? 0.0 : 0.5 * (1.0 + unit(random));
    const RuleResult result = base_of(node, BallPolynomial(x), BallPolynomial(y));
    const double bound = remainder_size(node, result.range, of_x, of_y);
    const double dx = unit(random) < 0.0 ? of_x : -of_x;
    const double dy = unit(random) < 0.0 ? of_y : -of_y;
    const double linear = result.by_first.constant() * dx + result.by_second.constant() * dy;
    const double remainder = std::max(x + dx, y + dy) - std::max(x, y) - linear;
    REQUIRE(std::abs(remainder) <= bound + 1e-14);
    share = bound > 1e-3 ? std::max(share, std::abs(remainder) / bound) : share;
  }
  CHECK(share > 0.99);
  CHECK(remainder_size(node, base_of(node, BallPolynomial(1.0), BallPolynomial(0.5)).range, 0.4, 0.0) == 0.0);
  const BallPolynomial across = BallPolynomial::affine(0.5, 0.2, 0.0, 0.0);
  const RuleResult of_cell = base_of(node, across, BallPolynomial(0.6));
  CHECK(of_cell.by_first.constant() == 0.5);
  CHECK(remainder_size(node, of_cell.range, 0.4, 0.2) >= 0.3);
}

TEST_CASE("A rule whose condition is not certain has no bound") {
  const auto size = [](PhaseOperation operation, double middle, double deviation) {
    const PhaseNode node{operation, 0, 0, Ball(-1.0), Ball(1.0)};
    return remainder_size(node, base_of(node, BallPolynomial(middle), {}).range, deviation, 0.0);
  };
  CHECK(std::isinf(size(PhaseOperation::reciprocal, 0.5, 0.5)));
  CHECK(std::isinf(size(PhaseOperation::root, 0.5, 0.51)));
  CHECK(std::isinf(size(PhaseOperation::logarithm, 0.5, 0.51)));
  CHECK(std::isinf(size(PhaseOperation::arcsine, 0.5, 0.51)));
  CHECK(std::isinf(size(PhaseOperation::tangent, 1.5, 0.1)));
  CHECK(size(PhaseOperation::within, 0.5, 0.4) == 0.0);
  CHECK(std::isinf(size(PhaseOperation::within, 0.5, 0.5)));
  CHECK(std::isinf(size(PhaseOperation::within, -0.5, 0.6)));
  CHECK(size(PhaseOperation::above, 0.5, 0.4) == 0.0);
  CHECK(size(PhaseOperation::above, -0.5, 0.4) == 0.0);
  CHECK(std::isinf(size(PhaseOperation::above, 0.5, 0.5)));
  CHECK(std::isinf(size(PhaseOperation::above, -0.5, 0.6)));
  const PhaseNode above{PhaseOperation::above, 0, 0, {}, {}};
  CHECK(base_of(above, BallPolynomial(0.5), {}).base.constant() == 1.0);
  CHECK(base_of(above, BallPolynomial(-0.5), {}).base.constant() == 0.0);
  CHECK_FALSE(base_of(above, BallPolynomial::affine(0.1, 0.2, 0.0, 0.0), {}).base.known());
  for (const double bad : {std::nan(""), HUGE_VAL, -1.0}) {
    CHECK(std::isinf(size(PhaseOperation::sine, 0.5, bad)));
    CHECK(std::isinf(size(PhaseOperation::within, 0.5, bad)));
  }
}

namespace {

PhaseGraph graph_of(const std::string& step, const std::vector<std::string>& states) {
  test::Loop loop;
  loop.states = states;
  loop.step = step;
  loop.frequency = states[0];
  loop.angles = {};
  loop.has_one_channel = true;
  loop.parameters = test::Json::object();
  return recorded_step(ModelRecursion(read_json(loop.model().dump())));
}

}  // namespace

TEST_CASE("A factor that nearly vanishes comes last, and products of two stay as they are") {
  const PhaseGraph graph = graph_of("a' = a + 0.1*(y - a)*b/a\nb' = b\n", {"a", "b"});
  const auto last = [](const PhaseGraph& of) {
    return of.nodes[of.nodes[of.nodes[of.results[0]].second].second].operation;
  };
  CHECK(last(graph) == PhaseOperation::reciprocal);
  CHECK(last(with_small_factors_last(graph, {{{1.0, 2.0}, {1.0001}}})) == PhaseOperation::difference);
  CHECK(last(with_small_factors_last(graph, {{{1.0, 2.0}, {1.1}}})) == PhaseOperation::reciprocal);
  const PhaseGraph pair = graph_of("a' = a + (y - a)*b\nb' = b\n", {"a", "b"});
  CHECK(last(with_small_factors_last(pair, {{{1.0, 2.0}, {1.0}}})) == last(pair));
}

TEST_CASE("Gates are the last values through which everything passes") {
  // u = a b reaches both results by c alone; w = sin(a) reaches them by two ways.
  const PhaseGraph graph = graph_of("u = a*b\nc = u + y\nw = sin(a)\na' = c + w\nb' = c*2 - w\n", {"a", "b"});
  const auto gates = gates_of(graph);
  std::size_t product = 0;
  std::size_t sine = 0;
  for (std::size_t node = 0; node < graph.nodes.size(); ++node) {
    product = is_nonlinear(graph.nodes, node) && graph.nodes[node].operation == PhaseOperation::product
                  ? node
                  : product;
    sine = graph.nodes[node].operation == PhaseOperation::sine ? node : sine;
  }
  REQUIRE(gates[product]);
  CHECK(graph.nodes[*gates[product]].operation == PhaseOperation::sum);
  CHECK(graph.nodes[*gates[product]].first == product);
  REQUIRE(gates[sine]);
  CHECK(*gates[sine] == sine);
  const PhaseStructure structure = phase_structure(graph, 2, 1, false);
  CHECK(structure.inputs.size() == 2);
  CHECK(structure.forms.size() == 2);  // a and b; the frequency is a
  CHECK(structure.forms[structure.error_form] == 0);
}

TEST_CASE("What no rule is about is not covered") {
  for (const std::string step :
       {"a' = clamp(a, 0, y)\n", "a' = clamp(a, 1, 0)\n", "a' = stays_within(a, 0, y)\n"}) {
    CAPTURE(step);
    CHECK_THROWS_AS(graph_of(step, {"a"}), NotCovered);
  }
  CHECK_NOTHROW(graph_of("a' = a*max(1, 2) + y\n", {"a"}));
}

}  // namespace veritrack::checker
