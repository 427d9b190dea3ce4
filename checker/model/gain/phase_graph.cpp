#include "checker/model/gain/phase_graph.hpp"

#include <string>
#include <utility>

#include "checker/model/gain/exact_number.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostNodes = 4096;

/// Whether both certainly compute the same; numbers only where they are exact.
bool are_same(const PhaseNode& x, const PhaseNode& y) {
  return x.operation == y.operation && x.operation != PhaseOperation::within && x.first == y.first &&
         x.second == y.second && (x.operation != PhaseOperation::number || certainly_equal(x.low, y.low));
}

/// The number of the node, which is that of an earlier one where both are the same: what is computed twice is
/// one value.
std::size_t added_to(std::vector<PhaseNode>& nodes, PhaseNode node) {
  for (std::size_t earlier = 0; earlier < nodes.size(); ++earlier) {
    if (are_same(nodes[earlier], node)) {
      return earlier;
    }
  }
  if (nodes.size() >= kMostNodes) {
    throw NotCovered("too many operations");
  }
  spend(static_cast<std::int64_t>(nodes.size() / 64 + 1));
  nodes.push_back(std::move(node));
  return nodes.size() - 1;
}

/// A scalar that records what is computed from states and samples; everything else is a number.
class Recorded {
 public:
  Recorded(const Ball& number) : number_(number) {}  // NOLINT(google-explicit-constructor)
  Recorded(double number) : number_(number) {}       // NOLINT(google-explicit-constructor)
  Recorded(std::vector<PhaseNode>& nodes, PhaseNode node)
      : nodes_(&nodes), node_(added_to(nodes, std::move(node))) {}

  [[nodiscard]] bool is_number() const { return nodes_ == nullptr; }
  [[nodiscard]] const Ball& number() const { return number_; }
  /// The node, in a graph.
  [[nodiscard]] std::size_t in(std::vector<PhaseNode>& nodes) const {
    return is_number() ? Recorded(nodes, {PhaseOperation::number, 0, 0, number_, {}}).node_ : node_;
  }
  [[nodiscard]] bool is(double value) const { return is_number() && certainly_equal(number_, Ball(value)); }
  [[nodiscard]] std::vector<PhaseNode>* nodes() const { return nodes_; }

 private:
  std::vector<PhaseNode>* nodes_ = nullptr;
  std::size_t node_ = 0;
  Ball number_;
};

Recorded record(PhaseOperation operation, const Recorded& x) {
  return {*x.nodes(), {operation, x.in(*x.nodes()), 0, {}, {}}};
}

Recorded record(PhaseOperation operation, const Recorded& x, const Recorded& y) {
  std::vector<PhaseNode>& nodes = x.is_number() ? *y.nodes() : *x.nodes();
  const std::size_t first = x.in(nodes);
  const std::size_t second = y.in(nodes);
  return {nodes, {operation, first, second, {}, {}}};
}

bool are_numbers(const Recorded& x, const Recorded& y) {
  return x.is_number() && y.is_number();
}

Recorded operator+(const Recorded& x, const Recorded& y) {
  return are_numbers(x, y) ? Recorded(x.number() + y.number())
         : x.is(0.0)       ? y
         : y.is(0.0)       ? x
                           : record(PhaseOperation::sum, x, y);
}
Recorded operator-(const Recorded& x) {
  return x.is_number() ? Recorded(-x.number()) : record(PhaseOperation::negation, x);
}
Recorded operator-(const Recorded& x, const Recorded& y) {
  return are_numbers(x, y) ? Recorded(x.number() - y.number())
         : x.is(0.0)       ? -y
         : y.is(0.0)       ? x
                           : record(PhaseOperation::difference, x, y);
}
Recorded operator*(const Recorded& x, const Recorded& y) {
  return are_numbers(x, y)        ? Recorded(x.number() * y.number())
         : x.is(0.0) || y.is(0.0) ? Recorded(0.0)
         : x.is(1.0)              ? y
         : y.is(1.0)              ? x
                                  : record(PhaseOperation::product, x, y);
}
Recorded operator/(const Recorded& x, const Recorded& y) {
  return x * (y.is_number() ? Recorded(reciprocal(y.number())) : record(PhaseOperation::reciprocal, y));
}

template <typename Function>
Recorded function_of(PhaseOperation operation, const Recorded& x, const Function& of_ball) {
  return x.is_number() ? Recorded(of_ball(x.number())) : record(operation, x);
}
Recorded sqrt(const Recorded& x) {
  return function_of(PhaseOperation::root, x, [](const Ball& b) { return sqrt(b); });
}
Recorded exp(const Recorded& x) {
  return function_of(PhaseOperation::exponential, x, [](const Ball& b) { return exp(b); });
}
Recorded log(const Recorded& x) {
  return function_of(PhaseOperation::logarithm, x, [](const Ball& b) { return log(b); });
}
Recorded sin(const Recorded& x) {
  return function_of(PhaseOperation::sine, x, [](const Ball& b) { return sin(b); });
}
Recorded cos(const Recorded& x) {
  return function_of(PhaseOperation::cosine, x, [](const Ball& b) { return cos(b); });
}
Recorded tangent(const Recorded& x) {
  return function_of(PhaseOperation::tangent, x, [](const Ball& b) { return tangent(b); });
}
Recorded arcsine(const Recorded& x) {
  return function_of(PhaseOperation::arcsine, x, [](const Ball& b) { return arcsine(b); });
}
Recorded arccosine(const Recorded& x) {
  return function_of(PhaseOperation::arccosine, x, [](const Ball& b) { return arccosine(b); });
}
Recorded arctangent(const Recorded& x) {
  return function_of(PhaseOperation::arctangent, x, [](const Ball& b) { return arctangent(b); });
}
Recorded arctangent2(const Recorded& y, const Recorded& x) {
  return are_numbers(x, y) ? Recorded(arctangent2(y.number(), x.number()))
                           : record(PhaseOperation::arctangent2, y, x);
}

[[noreturn]] void refuse(const std::string& function) {
  throw NotCovered("gains with phases do not cover " + function);
}
Recorded stays_within(const Recorded& x, const Recorded& low, const Recorded& high) {
  if (!are_numbers(low, high)) {
    refuse("limits that are not numbers");
  }
  return x.is_number() ? Recorded(stays_within(x.number(), low.number(), high.number()))
                       : Recorded(*x.nodes(),
                                  {PhaseOperation::within, x.in(*x.nodes()), 0, low.number(), high.number()});
}
Recorded larger(const Recorded& x, const Recorded& y) {
  return are_numbers(x, y) ? Recorded(larger(x.number(), y.number())) : record(PhaseOperation::larger, x, y);
}
Recorded clamped(const Recorded& x, const Recorded& low, const Recorded& high) {
  if (!are_numbers(low, high) || !certainly_at_most(low.number(), high.number())) {
    refuse("clamp with limits that are not numbers, or not in order");
  }
  return x.is_number() ? Recorded(clamped(x.number(), low.number(), high.number()))
                       : -larger(-larger(x, low), -high);
}
Recorded above_zero(const Recorded& x) {
  return function_of(PhaseOperation::above, x, [](const Ball& b) { return chosen(b, Ball(1.0), Ball(0.0)); });
}
Recorded chosen(const Recorded& positive, const Recorded& a, const Recorded& b) {
  return positive.is_number() && are_numbers(a, b)
             ? Recorded(chosen(positive.number(), a.number(), b.number()))
             : b + above_zero(positive) * (a - b);
}
Recorded sign_of(const Recorded& x) {
  return x.is_number() ? Recorded(sign_of(x.number())) : Recorded(-1.0) + Recorded(2.0) * above_zero(x);
}

}  // namespace

std::size_t operands_of(const PhaseNode& node) {
  switch (node.operation) {
    case PhaseOperation::number:
    case PhaseOperation::state:
    case PhaseOperation::sample:
      return 0;
    case PhaseOperation::sum:
    case PhaseOperation::difference:
    case PhaseOperation::product:
    case PhaseOperation::larger:
    case PhaseOperation::arctangent2:
      return 2;
    default:
      return 1;
  }
}

bool is_nonlinear(const std::vector<PhaseNode>& nodes, std::size_t node) {
  switch (nodes[node].operation) {
    case PhaseOperation::number:
    case PhaseOperation::state:
    case PhaseOperation::sample:
    case PhaseOperation::sum:
    case PhaseOperation::difference:
    case PhaseOperation::negation:
    case PhaseOperation::within:
      return false;
    case PhaseOperation::product:
      return nodes[nodes[node].first].operation != PhaseOperation::number &&
             nodes[nodes[node].second].operation != PhaseOperation::number;
    default:
      return true;
  }
}

PhaseGraph recorded_step(const ModelRecursion& recursion) {
  PhaseGraph graph;
  std::vector<Recorded> states;
  for (std::size_t i = 0; i < recursion.states(); ++i) {
    states.emplace_back(graph.nodes, PhaseNode{PhaseOperation::state, i, 0, {}, {}});
  }
  std::vector<Recorded> samples;
  for (std::size_t c = 0; c < recursion.samples(); ++c) {
    samples.emplace_back(graph.nodes, PhaseNode{PhaseOperation::sample, c, 0, {}, {}});
  }
  for (const Recorded& next : recursion.next(states, samples)) {
    graph.results.push_back(next.in(graph.nodes));
  }
  graph.frequency = recursion.frequency(states).in(graph.nodes);
  return graph;
}

}  // namespace veritrack::checker
