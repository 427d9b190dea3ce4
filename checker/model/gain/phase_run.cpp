#include "checker/model/gain/phase_run.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "checker/model/gain/exact_number.hpp"

namespace veritrack::checker {

namespace {

/// A value as its base and slopes, by variable.
struct SlopedValue {
  BallPolynomial base;
  std::map<std::size_t, BallPolynomial> slopes;

  void add(const SlopedValue& operand, const BallPolynomial& factor) {
    for (const auto& [variable, slope] : operand.slopes) {
      slopes[variable] += factor * slope;
    }
  }
  [[nodiscard]] BallPolynomial slope(std::size_t variable) const {
    const auto found = slopes.find(variable);
    return found == slopes.end() ? BallPolynomial() : found->second;
  }
};

class StepRun {
 public:
  StepRun(const PhaseStructure& structure, const TubeOver& here, std::vector<BallPolynomial> signal)
      : structure_(&structure), here_(&here), signal_(std::move(signal)) {
    run_.rules.resize(structure.rules.size());
    run_.to_input.assign(structure.rules.size(), 0.0);
    for (std::size_t node = 0; node < structure.graph.nodes.size(); ++node) {
      values_.push_back(value(node));
      if (!values_.back().base.known()) {
        throw NotCovered("a value of the step is not certainly defined on the curve");
      }
      take_remainders(node, values_.back());
    }
    read_forms();
  }

  [[nodiscard]] PhaseRun& run() { return run_; }
  [[nodiscard]] const SlopedValue& of(std::size_t node) const { return values_[node]; }

 private:
  [[nodiscard]] SlopedValue value(std::size_t node) {
    const PhaseNode& of = structure_->graph.nodes[node];
    SlopedValue result;
    switch (of.operation) {
      case PhaseOperation::number:
        result.base = BallPolynomial(of.low);
        return result;
      case PhaseOperation::state:
        result.base = here_->curve[of.first];
        for (std::size_t j = 0; j < structure_->states; ++j) {
          result.slopes[j] = here_->shape[of.first * structure_->states + j];
        }
        return result;
      case PhaseOperation::sample:
        result.base = signal_[of.first];
        result.slopes[structure_->noise(of.first)] = BallPolynomial(1.0);
        return result;
      default:
        break;
    }
    const bool has_two = operands_of(of) > 1;
    const SlopedValue none;
    const SlopedValue& first = values_[of.first];
    const SlopedValue& second = has_two ? values_[of.second] : none;
    RuleResult rule = base_of(of, first.base, second.base);
    result.base = std::move(rule.base);
    result.add(first, rule.by_first);
    if (has_two) {
      result.add(second, rule.by_second);
    }
    if (const std::optional<std::size_t> number = structure_->rule_of[node]) {
      run_.rules[*number] = rule.range;
      if (of.operation != PhaseOperation::within) {
        result.slopes[structure_->remainder(*number)] += BallPolynomial(1.0);
      }
    }
    return result;
  }

  /// Remainders become an input in the value that is their gate.
  void take_remainders(std::size_t node, SlopedValue& value) {
    const std::optional<std::size_t> input = structure_->input_of[node];
    if (!input) {
      return;
    }
    for (std::size_t r = 0; r < structure_->rules.size(); ++r) {
      if (structure_->rules[r].input == input) {
        run_.to_input[r] = largest_over_cell(value.slope(structure_->remainder(r)));
        value.slopes.erase(structure_->remainder(r));
      }
    }
    value.slopes[structure_->input(*input)] = BallPolynomial(1.0);
  }

  void read_forms() {
    for (const std::size_t node : structure_->forms) {
      run_.forms.emplace_back();
      run_.direct.emplace_back();
      for (std::size_t j = 0; j < structure_->states; ++j) {
        run_.forms.back().push_back(values_[node].slope(j));
      }
      for (const auto& [variable, slope] : values_[node].slopes) {
        if (variable >= structure_->states) {
          run_.direct.back().emplace_back(variable, largest_over_cell(slope));
        }
      }
    }
  }

  const PhaseStructure* structure_;
  const TubeOver* here_;
  std::vector<BallPolynomial> signal_;
  std::vector<SlopedValue> values_;
  PhaseRun run_;
};

/// Right sides of the equations for components of eta, which are solved together.
class Sides {
 public:
  explicit Sides(std::size_t n) : rows_(n) {}

  void add(const std::function<BallPolynomial(std::size_t row)>& entry) {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_[i].push_back(entry(i));
    }
  }
  void solve(PolynomialMatrix matrix) { rows_ = solution_of(std::move(matrix), std::move(rows_)); }
  /// The solutions, in the order in which their sides were added.
  [[nodiscard]] PolynomialRow next() {
    PolynomialRow column;
    for (PolynomialRow& row : rows_) {
      column.push_back(std::move(row[next_]));
    }
    ++next_;
    return column;
  }
  /// The next n of them, as the columns of a matrix.
  [[nodiscard]] PolynomialMatrix next_matrix() {
    PolynomialMatrix matrix(rows_.size());
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      PolynomialRow column = next();
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        matrix[i].push_back(std::move(column[i]));
      }
    }
    return matrix;
  }

 private:
  PolynomialMatrix rows_;
  std::size_t next_ = 0;
};

/// The variables of the step of which new components are functions.
std::vector<std::size_t> variables_of_step(const PhaseStructure& structure) {
  std::vector<std::size_t> variables;
  for (std::size_t v = 0; v < structure.remainder(0); ++v) {
    variables.push_back(v);
  }
  for (std::size_t input = 0; input < structure.inputs.size(); ++input) {
    variables.push_back(structure.input(input));
  }
  return variables;
}

PolynomialMatrix square_of(const std::vector<BallPolynomial>& entries, std::size_t n) {
  PolynomialMatrix matrix(n);
  for (std::size_t i = 0; i < n * n; ++i) {
    matrix[i / n].push_back(entries[i]);
  }
  return matrix;
}

}  // namespace

PhaseRun run_over(const PhaseStructure& structure, const TrackedModel& model, const PhaseCell& cell,
                  const TubePart& part) {
  const std::size_t n = structure.states;
  const TubeOver here(cell.tube, part, 0);
  const TubeOver there(cell.tube, part, 1);
  const std::vector<BallPolynomial> signal = signal_later(model, cell.tube, part);
  StepRun step(structure, here, signal);
  PhaseRun run = std::move(step.run());
  run.curve = here.curve;
  run.signal = signal;
  run.bias = step.of(structure.graph.frequency).base - frequency_over(cell.tube, part);
  const TubeOver slope(cell.slope, part, 1);
  const BallPolynomial per_frequency(one / Ball(cell.tube.half_width));
  const std::vector<std::size_t> variables = variables_of_step(structure);
  Sides sides(n);
  for (std::size_t j = 0; j < n; ++j) {
    sides.add([&](std::size_t i) { return BallPolynomial(i == j ? 1.0 : 0.0); });
  }
  for (std::size_t j = 0; j < n; ++j) {
    sides.add([&](std::size_t i) { return per_frequency * slope.shape[i * n + j]; });
  }
  const std::vector<std::size_t>& results = structure.graph.results;
  sides.add([&](std::size_t i) { return step.of(results[i]).base - there.curve[i]; });
  sides.add([&](std::size_t i) { return -(per_frequency * slope.curve[i]); });
  for (const std::size_t variable : variables) {
    sides.add([&](std::size_t i) { return step.of(results[i]).slope(variable); });
  }
  sides.solve(square_of(there.shape, n));
  run.inverse = sides.next_matrix();
  run.turned = sides.next_matrix();
  run.residual = sides.next();
  run.slew = sides.next();
  for (std::size_t v = 0; v < variables.size(); ++v) {
    run.columns.push_back(sides.next());
  }
  return run;
}

}  // namespace veritrack::checker
