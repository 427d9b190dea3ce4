#include "lift/obligations.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include "lift/cell_names.hpp"

namespace veritrack::lift {

namespace {

/// The registers that a position needs without what makes values undefined: the frequency, the states, and
/// what the program must not get to.
std::vector<int> roots_of(Graph& graph, const Position& position, const std::set<Spot>& needed_after) {
  std::vector<int> roots{position.frequency};
  for (const Spot& spot : needed_after) {
    roots.push_back(position.next.at(spot));
  }
  for (const Condition& condition : position.conditions) {
    if (condition.of < 0) {
      int all = condition.must_be_zero;
      for (const int step : condition.path) {
        all = graph.both(all, step);
      }
      roots.push_back(all);
    }
  }
  return roots;
}

/// All that a position needs.
std::vector<bool> needed_at(Graph& graph, const Position& position, const std::set<Spot>& needed_after) {
  std::vector<int> roots = roots_of(graph, position, needed_after);
  std::vector<bool> needed = needed_by(graph, roots);
  for (bool grows = true; grows;) {
    const std::size_t before = roots.size();
    std::set<int> known(roots.begin(), roots.end());
    for (const Condition& condition : position.conditions) {
      if (condition.of >= 0 && needed[static_cast<std::size_t>(condition.of)]) {
        std::vector<int> more = condition.path;
        more.push_back(condition.must_be_zero);
        std::copy_if(more.begin(), more.end(), std::back_inserter(roots),
                     [&](int root) { return known.insert(root).second; });
      }
    }
    grows = roots.size() != before;
    needed = needed_by(graph, roots);
  }
  return needed;
}

/// For each register the bits that are 1 wherever it is used: conditions of the selects that take it.
std::vector<std::set<int>> uses_of(Graph& graph, const std::vector<int>& roots) {
  const std::vector<bool> needed = needed_by(graph, roots);
  std::vector<std::optional<std::set<int>>> where(needed.size());
  for (const int root : roots) {
    where[static_cast<std::size_t>(root)].emplace();
  }
  const auto use = [&](int value, std::set<int> user) {
    if (value < 0) {
      return;
    }
    auto& known = where[static_cast<std::size_t>(value)];
    if (!known) {
      known = std::move(user);
      return;
    }
    std::set<int> both;
    std::set_intersection(known->begin(), known->end(), user.begin(), user.end(),
                          std::inserter(both, both.end()));
    known = std::move(both);
  };
  for (auto i = needed.size(); i-- > 0;) {
    if (!needed[i] || !where[i]) {
      continue;
    }
    const Instruction instruction = graph.at(static_cast<int>(i));
    const std::set<int> here = *where[i];
    const auto [a, b, c] = instruction.operands;
    if (instruction.operation != Operation::select) {
      for (const int operand : instruction.operands) {
        use(operand, here);
      }
      continue;
    }
    use(a, here);
    std::set<int> taken = here;
    taken.insert(a);
    use(b, std::move(taken));
    taken = here;
    taken.insert(graph.negated(a));
    use(c, std::move(taken));
  }
  std::vector<std::set<int>> result;
  for (auto& each : where) {
    result.push_back(each.value_or(std::set<int>{}));
  }
  return result;
}

}  // namespace

std::vector<bool> needed_by(const Graph& graph, const std::vector<int>& roots) {
  std::vector<bool> needed(graph.size(), false);
  for (const int root : roots) {
    needed[static_cast<std::size_t>(root)] = true;
  }
  // Operands come before what is made of them.
  for (auto i = needed.size(); i-- > 0;) {
    for (const int operand : graph.at(static_cast<int>(i)).operands) {
      if (needed[i] && operand >= 0) {
        needed[static_cast<std::size_t>(operand)] = true;
      }
    }
  }
  return needed;
}

std::vector<std::set<Spot>> needed_states(Executor& executor, const Orbit& orbit) {
  const std::size_t count = orbit.positions.size();
  std::vector<std::set<Spot>> result(count);
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t p = 0; p < count; ++p) {
      const Position& position = orbit.positions[p];
      const std::set<Spot>& after = result[(p + 1) % count];
      for (const Spot& spot : after) {
        if (position.next.at(spot) < 0) {
          throw LiftError(cell_name(executor.memory().object(spot.first), spot.second) +
                          " is not defined after a step");
        }
      }
      const std::vector<bool> needed = needed_at(executor.graph(), position, after);
      for (const auto& [spot, state] : orbit.states) {
        if (needed[static_cast<std::size_t>(state.input)]) {
          grows = result[p].insert(spot).second || grows;
        }
      }
    }
  }
  return result;
}

std::vector<Required> obligations_of(Graph& graph, const Position& position,
                                     const std::set<Spot>& needed_after) {
  const std::vector<bool> needed = needed_at(graph, position, needed_after);
  const std::vector<std::set<int>> uses = uses_of(graph, roots_of(graph, position, needed_after));
  std::vector<Required> result;
  for (const Condition& condition : position.conditions) {
    if (condition.of >= 0 && !needed[static_cast<std::size_t>(condition.of)]) {
      continue;
    }
    std::set<int> where(condition.path.begin(), condition.path.end());
    if (condition.of >= 0 && static_cast<std::size_t>(condition.of) < uses.size()) {
      const std::set<int>& more = uses[static_cast<std::size_t>(condition.of)];
      where.insert(more.begin(), more.end());
    }
    int all = condition.must_be_zero;
    for (const int bit : where) {
      all = graph.both(all, bit);
    }
    const bool is_zero = graph.is_known(all) && graph.bits(all) == 0;
    const bool is_listed = std::any_of(result.begin(), result.end(), [&](const Required& each) {
      return each.must_be_zero == all && each.condition->why == condition.why;
    });
    if (!is_zero && !is_listed) {
      result.push_back({all, &condition});
    }
  }
  return result;
}

}  // namespace veritrack::lift
