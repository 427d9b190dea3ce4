// The order of factors, and gates.
#include "checker/model/gain/phase_graph.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace veritrack::checker {

namespace {

constexpr double kNearlyVanishes = 0x1p-10;

/// Near the value. Nothing rests on it but the order of factors.
double near_value(const PhaseNode& node, const std::vector<double>& values, const SteadyPoint& point) {
  const double x = operands_of(node) > 0 ? values[node.first] : 0.0;
  const double y = operands_of(node) > 1 ? values[node.second] : 0.0;
  switch (node.operation) {
    case PhaseOperation::number:
      return node.low.near();
    case PhaseOperation::state:
      return point.states[node.first];
    case PhaseOperation::sample:
      return point.samples[node.first];
    case PhaseOperation::sum:
      return x + y;
    case PhaseOperation::difference:
      return x - y;
    case PhaseOperation::negation:
      return -x;
    case PhaseOperation::product:
      return x * y;
    case PhaseOperation::reciprocal:
      return 1.0 / x;
    case PhaseOperation::larger:
      return std::max(x, y);
    case PhaseOperation::above:
      return x > 0.0 ? 1.0 : 0.0;
    case PhaseOperation::within:
      return x;
    case PhaseOperation::arctangent2:
      return std::atan2(x, y);
    case PhaseOperation::sine:
      return std::sin(x);
    case PhaseOperation::cosine:
      return std::cos(x);
    case PhaseOperation::root:
      return std::sqrt(x);
    case PhaseOperation::exponential:
      return std::exp(x);
    case PhaseOperation::logarithm:
      return std::log(x);
    case PhaseOperation::tangent:
      return std::tan(x);
    case PhaseOperation::arcsine:
      return std::asin(x);
    case PhaseOperation::arccosine:
      return std::acos(x);
    case PhaseOperation::arctangent:
      return std::atan(x);
  }
  return 0.0;
}

/// By node, the largest size over the points.
std::vector<double> largest_sizes(const PhaseGraph& graph, const std::vector<SteadyPoint>& points) {
  std::vector<double> largest(graph.nodes.size(), 0.0);
  std::vector<double> values(graph.nodes.size(), 0.0);
  for (const SteadyPoint& point : points) {
    for (std::size_t node = 0; node < values.size(); ++node) {
      values[node] = near_value(graph.nodes[node], values, point);
      largest[node] = std::max(largest[node], std::abs(values[node]));
    }
  }
  return largest;
}

std::vector<std::size_t> counted_uses(const PhaseGraph& graph) {
  std::vector<std::size_t> uses(graph.nodes.size(), 0);
  for (const PhaseNode& node : graph.nodes) {
    for (std::size_t i = 0; i < operands_of(node); ++i) {
      ++uses[i == 0 ? node.first : node.second];
    }
  }
  for (const std::size_t result : graph.results) {
    ++uses[result];
  }
  ++uses[graph.frequency];
  return uses;
}

class FactorOrder {
 public:
  FactorOrder(const PhaseGraph& graph, const std::vector<SteadyPoint>& points)
      : graph_(&graph), largest_(largest_sizes(graph, points)), is_inside_(graph.nodes.size(), false) {
    const std::vector<std::size_t> uses = counted_uses(graph);
    for (const PhaseNode& node : graph.nodes) {
      for (const std::size_t operand : {node.first, node.second}) {
        if (node.operation == PhaseOperation::product && is_product(operand) && uses[operand] == 1) {
          is_inside_[operand] = true;
        }
      }
    }
  }

  [[nodiscard]] PhaseGraph graph() {
    std::vector<std::size_t> moved(graph_->nodes.size());
    for (std::size_t node = 0; node < moved.size(); ++node) {
      if (is_inside_[node]) {
        continue;  // it comes with the product that it is a factor of
      }
      if (is_product(node)) {
        moved[node] = product_of(ordered_factors(node), moved);
        continue;
      }
      PhaseNode copy = graph_->nodes[node];
      if (operands_of(copy) > 0) {
        copy.first = moved[copy.first];
        copy.second = operands_of(copy) > 1 ? moved[copy.second] : 0;
      }
      result_.nodes.push_back(std::move(copy));
      moved[node] = result_.nodes.size() - 1;
    }
    for (const std::size_t result : graph_->results) {
      result_.results.push_back(moved[result]);
    }
    result_.frequency = moved[graph_->frequency];
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_product(std::size_t node) const {
    return graph_->nodes[node].operation == PhaseOperation::product;
  }
  [[nodiscard]] bool nearly_vanishes(std::size_t node) const {
    const PhaseNode& of = graph_->nodes[node];
    return (of.operation == PhaseOperation::sum || of.operation == PhaseOperation::difference) &&
           largest_[node] < kNearlyVanishes * largest_[of.first] &&
           largest_[node] < kNearlyVanishes * largest_[of.second];
  }
  [[nodiscard]] std::vector<std::size_t> ordered_factors(std::size_t product) const {
    std::vector<std::size_t> factors;
    std::vector<std::size_t> open = {product};
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      if (node == product || is_inside_[node]) {
        open.push_back(graph_->nodes[node].second);
        open.push_back(graph_->nodes[node].first);
      } else {
        factors.push_back(node);
      }
    }
    if (factors.size() > 2) {
      std::stable_partition(factors.begin(), factors.end(),
                            [&](std::size_t factor) { return !nearly_vanishes(factor); });
    }
    return factors;
  }
  [[nodiscard]] std::size_t product_of(const std::vector<std::size_t>& factors,
                                       const std::vector<std::size_t>& moved) {
    std::size_t product = moved[factors.front()];
    for (std::size_t i = 1; i < factors.size(); ++i) {
      const std::size_t factor = moved[factors[i]];
      if (result_.is_number(product) && result_.is_number(factor)) {
        const Ball number = result_.nodes[product].low * result_.nodes[factor].low;
        result_.nodes.push_back({PhaseOperation::number, 0, 0, number, {}});
      } else {
        result_.nodes.push_back({PhaseOperation::product, product, factor, {}, {}});
      }
      product = result_.nodes.size() - 1;
    }
    return product;
  }

  const PhaseGraph* graph_;
  std::vector<double> largest_;
  std::vector<bool> is_inside_;  ///< a product that is a factor of one other product, and nothing else
  PhaseGraph result_;
};

}  // namespace

PhaseGraph with_small_factors_last(const PhaseGraph& graph, const std::vector<SteadyPoint>& points) {
  return FactorOrder(graph, points).graph();
}

std::vector<std::optional<std::size_t>> gates_of(const PhaseGraph& graph) {
  const std::size_t count = graph.nodes.size();
  const std::size_t exit = count;
  // The immediate post-dominator of each node: what follows it in all ways to the exit, the nearest one. All
  // ways go from smaller numbers to larger ones, so that two chains meet by going on from the smaller number.
  std::vector<std::optional<std::size_t>> next(count);
  const auto meet = [&](std::size_t x, std::size_t y) {
    while (x != y) {
      (x < y ? x : y) = *next[std::min(x, y)];
    }
    return x;
  };
  const auto joined = [&](std::optional<std::size_t> found, std::size_t user) {
    return found ? meet(*found, user) : user;
  };
  for (const std::size_t result : graph.results) {
    next[result] = exit;
  }
  for (std::size_t user = count; user-- > 0;) {
    if (!next[user]) {
      continue;  // nothing that it does reaches the results
    }
    const PhaseNode& node = graph.nodes[user];
    for (std::size_t i = 0; i < operands_of(node); ++i) {
      std::optional<std::size_t>& of_operand = next[i == 0 ? node.first : node.second];
      of_operand = joined(of_operand, user);
    }
  }
  std::vector<std::optional<std::size_t>> gates(count);
  for (std::size_t node = count; node-- > 0;) {
    if (next[node]) {
      gates[node] = *next[node] == exit ? node : gates[*next[node]];
    }
  }
  return gates;
}

}  // namespace veritrack::checker
