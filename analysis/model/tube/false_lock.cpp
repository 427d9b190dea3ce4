#include "analysis/model/tube/false_lock.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "analysis/rigor/dual_functions.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/piecewise.hpp"

namespace veritrack::model {

namespace {

using rigor::Interval;
using trackers::Instruction;
using trackers::Operation;
using trackers::StraightLineProgram;

constexpr long kMostDegree = 1'000'000;

/// A register as a quotient of polynomials in the states and in sines and cosines of them: its degrees, and
/// the whole factors and divisors of each state in it. Sines and cosines of a sum of states alone have the
/// largest of these as their degree.
struct Degree {
  std::vector<long> multiples;  ///< of the states
  bool is_sum = true;           ///< of multiples of states
  long numerator = 0;
  long denominator = 0;

  [[nodiscard]] long both() const { return std::min(numerator + denominator, kMostDegree); }
  [[nodiscard]] long multiple() const {
    return multiples.empty() ? 0 : *std::max_element(multiples.begin(), multiples.end());
  }
  [[nodiscard]] bool is_constant() const { return both() == 0 && multiple() == 0; }
};

Degree combined(const Degree& a, const Degree& b) {
  Degree result = a;
  for (std::size_t i = 0; i < result.multiples.size(); ++i) {
    result.multiples[i] = std::min(a.multiples[i] + b.multiples[i], kMostDegree);
  }
  return result;
}

Degree sum_of(const Degree& a, const Degree& b) {
  Degree result = combined(a, b);
  result.is_sum = a.is_sum && b.is_sum;
  result.numerator =
      std::min(std::max(a.numerator + b.denominator, b.numerator + a.denominator), kMostDegree);
  result.denominator = std::min(a.denominator + b.denominator, kMostDegree);
  return result;
}

Degree product_of(const Degree& a, const Degree& b) {
  Degree result = combined(a, b);
  result.is_sum = (a.is_constant() && b.is_sum) || (b.is_constant() && a.is_sum);
  result.numerator = std::min(a.numerator + b.numerator, kMostDegree);
  result.denominator = std::min(a.denominator + b.denominator, kMostDegree);
  return result;
}

Degree inverse_of(Degree a) {
  a.is_sum = a.is_constant();
  std::swap(a.numerator, a.denominator);
  return a;
}

/// Twice the degree: a sum of roots may repeat more often than each of them.
Degree function_of(Degree a) {
  a.is_sum = a.is_constant();
  for (long& each : a.multiples) {
    each = std::min(each, 1L);
  }
  a.numerator = a.denominator = a.both();
  return a;
}

Degree periodic_in(const Degree& a, bool has_poles) {
  Degree result = a;
  std::fill(result.multiples.begin(), result.multiples.end(), 0L);
  result.is_sum = a.is_constant();
  result.numerator = std::min(a.multiple() + (a.is_sum ? 0 : 2 * a.both()), kMostDegree);
  result.denominator = has_poles ? result.numerator : 0;
  return result;
}

/// The degrees of all registers. Inputs: constants, then `variables`, whose degrees are counted, then others.
std::vector<Degree> degrees_of(const StraightLineProgram& program, const std::vector<Interval>& constants,
                               std::size_t variables) {
  Degree nothing;
  nothing.multiples.assign(variables, 0);
  std::vector<Degree> registers(static_cast<std::size_t>(program.inputs()), nothing);
  for (std::size_t i = 0; i < variables; ++i) {
    registers[constants.size() + i].multiples[i] = 1;
    registers[constants.size() + i].numerator = 1;
  }
  // The whole number that a constant is; 1 for others.
  const auto whole = [&](int place) {
    const auto number = static_cast<std::size_t>(place);
    if (number >= constants.size() || constants[number].lower() != constants[number].upper()) {
      return 1L;
    }
    const double value = std::fabs(constants[number].lower());
    return std::floor(value) == value && value <= 1000.0 ? std::max(1L, static_cast<long>(value)) : 1L;
  };
  for (const Instruction& made : program.instructions()) {
    const auto at = [&](int place) -> const Degree& { return registers[static_cast<std::size_t>(place)]; };
    const Degree& a = at(made.first);
    Degree result;
    switch (made.operation) {
      case Operation::add:
      case Operation::subtract:
        result = sum_of(a, at(made.second));
        break;
      case Operation::multiply:
      case Operation::divide: {
        const Degree& b = at(made.second);
        result = product_of(a, made.operation == Operation::divide ? inverse_of(b) : b);
        const long factor = whole(made.first) > 1 ? whole(made.first) : whole(made.second);
        for (long& each : result.multiples) {
          each = std::min(each * factor, kMostDegree);
        }
        break;
      }
      case Operation::power:
        result = a;
        for (int i = 1; i < made.exponent; ++i) {
          result = product_of(result, a);
        }
        break;
      case Operation::negate:
      case Operation::stays_within:
        result = a;
        break;
      case Operation::sin:
      case Operation::cos:
      case Operation::tan:
        result = periodic_in(a, made.operation == Operation::tan);
        break;
      case Operation::atan2:
        result = function_of(product_of(a, inverse_of(at(made.second))));
        break;
      case Operation::minimum:
      case Operation::maximum:
        result = function_of(sum_of(a, at(made.second)));
        break;
      case Operation::clamp:
      case Operation::choose:
        result = function_of(sum_of(sum_of(a, at(made.second)), at(made.third)));
        break;
      default:
        result = function_of(a);
    }
    registers.push_back(std::move(result));
  }
  return registers;
}

/// The largest degree of the results, and at least 1.
long degree_of_results(const StraightLineProgram& program, const std::vector<Degree>& registers) {
  long most = 1;
  for (const int place : program.results()) {
    most = std::max(most, registers[static_cast<std::size_t>(place)].both());
  }
  return most;
}

/// |Y'| > 0 at all phases.
bool moves_on(const TrackerModel& model) {
  using Dual = rigor::Dual<Interval, 1>;
  constexpr int kParts = 256;
  std::vector<Dual> inputs(model.constants.begin(), model.constants.end());
  inputs.emplace_back(model.amplitude);
  inputs.emplace_back(Interval(0.0));
  std::vector<Dual> registers;
  std::vector<Dual> samples(model.signal->results().size());
  for (int k = 0; k < kParts; ++k) {
    const Interval phase =
        Interval(2.0) * rigor::pi() * Interval::from_bounds(k, k + 1) / Interval(static_cast<double>(kParts));
    inputs.back() = Dual(phase, {Interval(1.0)});
    model.signal->run(std::span<const Dual>(inputs), registers, std::span<Dual>(samples));
    Interval squares(0.0);
    for (const Dual& sample : samples) {
      squares += square(sample.derivative(0));
    }
    if (!rigor::certainly_less(Interval(0.0), squares)) {
      return false;
    }
  }
  return true;
}

}  // namespace

double half_distance_to_false_lock(const TrackerModel& model, const Interval& band) {
  const auto states = static_cast<std::size_t>(model.recursion->states);
  const StraightLineProgram& estimate = model.recursion->frequency;
  const std::vector<Degree> of_frequency = degrees_of(estimate, model.constants, states);
  const Degree& frequency = of_frequency[static_cast<std::size_t>(estimate.results().front())];
  const bool has_parts = model.filter != nullptr;
  const StraightLineProgram& step = has_parts ? model.filter->program : model.recursion->step;
  const std::size_t variables = has_parts ? static_cast<std::size_t>(model.filter->states) : states;
  constexpr long kSpareOfFilters = 2;
  const long of_step = degree_of_results(step, degrees_of(step, model.constants, variables));
  const long degree = std::max(has_parts ? kSpareOfFilters * of_step : of_step, frequency.both());
  // The signal's inputs are constants, amplitude and phase; its amplitude counts as a constant.
  std::vector<Interval> known = model.constants;
  known.push_back(model.amplitude);
  const long harmonics = degree_of_results(*model.signal, degrees_of(*model.signal, known, 1));
  const long parts = std::max(std::min(degree * std::max(1L, frequency.multiple()), kMostDegree), harmonics);
  double half = (rigor::pi() / Interval(static_cast<double>(parts))).lower();
  if (!moves_on(model)) {
    half = std::min({half, band.lower(), (rigor::pi() - Interval(band.upper())).lower()});
  }
  if (harmonics > 1) {
    half = std::min(half, (Interval(band.lower()) / Interval(2.0 * static_cast<double>(harmonics))).lower());
  }
  return half;
}

}  // namespace veritrack::model
