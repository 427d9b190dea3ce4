#include "lift/renaming.hpp"

#include <string>
#include <utility>

#include "lift/cell_names.hpp"

namespace veritrack::lift {

namespace {

/// Whether registers are one formula up to the names of states.
class Unification {
 public:
  Unification(const Graph& graph, const std::map<int, Spot>& cells) : graph_(&graph), cells_(&cells) {}

  [[nodiscard]] bool unify(int a, int b) {
    std::vector<std::pair<int, int>> open{{a, b}};
    while (!open.empty()) {
      const auto pair = open.back();
      open.pop_back();
      if (!seen_.insert(pair).second) {
        continue;
      }
      const Instruction& x = graph_->at(pair.first);
      const Instruction& y = graph_->at(pair.second);
      const auto cell = cells_->find(pair.first);
      if (cell != cells_->end()) {
        const auto other = cells_->find(pair.second);
        if (other == cells_->end() || !(x.format == y.format) || !name(cell->second, other->second)) {
          return false;
        }
        continue;
      }
      if (x.operation != y.operation || !(x.format == y.format) || x.predicate != y.predicate ||
          x.table != y.table || x.bits != y.bits || cells_->contains(pair.second)) {
        return false;
      }
      for (std::size_t k = 0; k < x.operands.size(); ++k) {
        if ((x.operands[k] < 0) != (y.operands[k] < 0)) {
          return false;
        }
        if (x.operands[k] >= 0) {
          open.emplace_back(x.operands[k], y.operands[k]);
        }
      }
    }
    return true;
  }

  [[nodiscard]] const std::map<Spot, Spot>& names() const { return names_; }

 private:
  [[nodiscard]] bool name(Spot from, Spot to) {
    const auto [known, is_new] = names_.try_emplace(from, to);
    return known->second == to && (!is_new || taken_.insert(to).second);
  }

  const Graph* graph_;
  const std::map<int, Spot>* cells_;
  std::set<std::pair<int, int>> seen_;
  std::map<Spot, Spot> names_;
  std::set<Spot> taken_;
};

[[noreturn]] void refuse() {
  throw StepsDiffer(
      "what a step computes depends on an index or a mode that changes from step to step; allowed: an index "
      "that only says where in a ring past values are");
}

}  // namespace

std::vector<std::map<Spot, Spot>> renamings(Executor& executor, const Orbit& orbit,
                                            const std::vector<std::set<Spot>>& needed,
                                            const std::vector<std::vector<Required>>& required) {
  const std::size_t count = orbit.positions.size();
  std::map<int, Spot> cells;
  for (const auto& [spot, state] : orbit.states) {
    cells[state.input] = spot;
  }
  std::vector<Unification> found(count, Unification(executor.graph(), cells));
  const auto require = [](bool is_one_formula) {
    if (!is_one_formula) {
      refuse();
    }
  };
  for (std::size_t p = 0; p < count; ++p) {
    const std::size_t next = (p + 1) % count;
    require(found[p].unify(orbit.positions[p].frequency, orbit.positions[next].frequency));
    require(required[p].size() == required[next].size());
    for (std::size_t i = 0; i < required[p].size(); ++i) {
      require(required[p][i].condition->why == required[next][i].condition->why &&
              found[p].unify(required[p][i].must_be_zero, required[next][i].must_be_zero));
    }
  }
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t p = 0; p < count; ++p) {
      const std::size_t next = (p + 1) % count;
      const std::size_t before = found[p].names().size();
      for (const auto& [from, to] : std::map<Spot, Spot>(found[next].names())) {
        require(found[p].unify(orbit.positions[p].next.at(from), orbit.positions[next].next.at(to)));
      }
      grows = grows || found[p].names().size() != before;
    }
  }
  std::vector<std::map<Spot, Spot>> result;
  for (std::size_t p = 0; p < count; ++p) {
    std::map<Spot, Spot> names = found[p].names();
    const std::set<Spot>& after = needed[(p + 1) % count];
    require(names.size() == needed[p].size() && after.size() == needed[p].size());
    for (const auto& [from, to] : names) {
      require(needed[p].contains(from) && after.contains(to));
    }
    result.push_back(std::move(names));
  }
  return result;
}

int age_of(const Orbit& orbit, Spot spot) {
  const std::size_t count = orbit.positions.size();
  for (std::size_t age = 1; age <= count; ++age) {
    const Position& step = orbit.positions[(count - age) % count];
    if (step.next.at(spot) != orbit.states.at(spot).input) {
      return static_cast<int>(age);
    }
  }
  return 0;
}

}  // namespace veritrack::lift
