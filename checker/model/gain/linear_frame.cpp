#include "checker/model/gain/linear_frame.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "checker/model/gain/frame_function.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostValues = 20'000;
constexpr std::size_t kMostInputs = 96;

}  // namespace

void require_plain(const LinearValue& x) {
  if (!x.is_plain()) {
    throw NotCovered(
        "an angle, or a value that depends on the phase, is used other than in sums, sin and cos");
  }
}

void add_deviations(LinearValue& sum, const LinearValue& x, const Ball& factor) {
  for (const auto& [source, of_x] : x.deviations) {
    InputFactor& entry = sum.deviations[source];
    entry.first += factor * of_x.first;
    entry.second += factor * of_x.second;
    if (certainly_equal(entry.first, zero) && certainly_equal(entry.second, zero)) {
      sum.deviations.erase(source);
    }
  }
}

LinearFrame::LinearFrame(std::size_t states, Ball least_amplitude, Ball largest_amplitude, const Ball& lowest,
                         const Ball& highest, std::size_t channels, bool has_one_noise)
    : states_(states),
      channels_(channels),
      has_one_noise_(has_one_noise),
      least_(std::move(least_amplitude)),
      largest_(std::move(largest_amplitude)),
      frequency_(Ball::hull(lowest, highest)) {
  if (has_one_noise && channels != 2) {
    throw NotCovered("the noise of a sample is one input in two channels only");
  }
}

Ball LinearFrame::base(const LinearValue& value) const {
  return value.constant + value.per_frequency * frequency_;
}

int LinearFrame::keep(const std::string& name, LinearValue value) {
  const bool is_known = value.constant.finite() && value.per_frequency.finite() &&
                        std::all_of(value.deviations.begin(), value.deviations.end(), [](const auto& entry) {
                          return entry.second.first.finite() && entry.second.second.finite();
                        });
  if (!is_known || std::labs(value.turns) > 1000 || values_.size() >= kMostValues) {
    throw NotCovered("a value that is not known, or too many values");
  }
  if (value.is_constant() && exact_units(value.constant) && name.front() != '#') {
    return names_[name] = number(value.constant);
  }
  const int place = static_cast<int>(values_.size());
  if (value.is_constant()) {
    const std::optional<std::int64_t> units = exact_units(value.constant);
    factors_[place] = units ? ConstantFactors{*units, {}} : ConstantFactors{kExactUnit, {place}};
  }
  values_.push_back(std::move(value));
  return names_[name] = place;
}

int LinearFrame::made(const std::string& name, const std::function<LinearValue()>& make) {
  spend(100);
  const auto found = names_.find(name);
  return found != names_.end() ? found->second : keep(name, make());
}

int LinearFrame::number(const Ball& value) {
  LinearValue result;
  result.constant = value;
  if (const std::optional<std::int64_t> units = exact_units(value)) {
    return made("#" + std::to_string(*units), [&] { return result; });
  }
  return keep("new " + std::to_string(values_.size()), result);  // never the same as another
}

int LinearFrame::constant(const Ball& value, std::size_t place) {
  LinearValue result;
  result.constant = value;
  return made("constant " + std::to_string(place), [&] { return result; });
}

int LinearFrame::state(std::size_t index, const LinearValue& value) {
  return made("state " + std::to_string(index), [&] { return value; });
}

std::size_t LinearFrame::add_input(FrameInput input) {
  if (inputs_.size() >= kMostInputs) {
    throw NotCovered("too many inputs");
  }
  inputs_.push_back(std::move(input));
  return states_ + inputs_.size() - 1;
}

std::size_t LinearFrame::named_input(const std::string& name, const std::function<FrameInput()>& make) {
  const auto found = input_names_.find(name);
  if (found != input_names_.end()) {
    return found->second;
  }
  return input_names_[name] = add_input(make());
}

std::optional<long> LinearFrame::whole(int x) const {
  const auto found = factors_.find(x);
  if (found == factors_.end() || !found->second.named.empty() || found->second.exact % kExactUnit != 0) {
    return std::nullopt;
  }
  return static_cast<long>(found->second.exact / kExactUnit);
}

ConstantFactors LinearFrame::factors(int constant) const {
  return factors_.at(constant);
}

int LinearFrame::sum(int x, int y) {
  if (whole(x) == 0) {
    return y;
  }
  if (whole(y) == 0) {
    return x;
  }
  return made("+ " + std::to_string(std::min(x, y)) + " " + std::to_string(std::max(x, y)), [&] {
    LinearValue result = at(x);
    const LinearValue& other = at(y);
    result.turns += other.turns;
    result.constant += other.constant;
    result.per_frequency += other.per_frequency;
    result.is_modulo_turn = result.is_modulo_turn || other.is_modulo_turn;
    add_deviations(result, other, one);
    return result;
  });
}

int LinearFrame::negated(int x) {
  return product(number(Ball(-1.0)), x);
}

LinearValue LinearFrame::scaled(const LinearValue& x, int constant) const {
  LinearValue result;
  const Ball& factor = at(constant).constant;
  if (!x.is_plain()) {
    const std::optional<long> times = whole(constant);
    if (!times) {
      require_plain(x);
    }
    result.turns = x.turns * *times;
    result.is_modulo_turn = x.is_modulo_turn;
  }
  result.constant = factor * x.constant;
  result.per_frequency = factor * x.per_frequency;
  add_deviations(result, x, factor);
  return result;
}

LinearValue LinearFrame::product_of_plain(int x, int y) {
  const LinearValue left = at(x);
  const LinearValue right = at(y);
  require_plain(left);
  require_plain(right);
  const Ball of_left = base(left);
  const Ball of_right = base(right);
  LinearValue result;
  if (certainly_equal(left.per_frequency, zero) || certainly_equal(right.per_frequency, zero)) {
    result.constant = x == y ? square(left.constant) : left.constant * right.constant;
    result.per_frequency = left.per_frequency * right.constant + right.per_frequency * left.constant;
  } else {
    result.constant = x == y ? square(of_left) : of_left * of_right;
  }
  add_deviations(result, left, of_right);
  add_deviations(result, right, of_left);
  if (!left.deviations.empty() && !right.deviations.empty()) {
    const std::size_t source = add_input(
        {nullptr, {x, y}, [](const std::vector<Ball>& bounds) { return bounds.at(0) * bounds.at(1); }});
    result.deviations[source] = {one, zero};
  }
  return result;
}

int LinearFrame::product(int x, int y) {
  if (whole(x) == 1) {
    return y;
  }
  if (whole(y) == 1) {
    return x;
  }
  const bool constants = at(x).is_constant() && at(y).is_constant();
  const std::string name = "* " + std::to_string(std::min(x, y)) + " " + std::to_string(std::max(x, y));
  const bool is_new = !names_.contains(name);
  const int result = made(name, [&] {
    return at(x).is_constant()   ? scaled(at(y), x)
           : at(y).is_constant() ? scaled(at(x), y)
                                 : product_of_plain(x, y);
  });
  // A product of constants is known by its factors.
  if (constants && is_new && factors_.contains(result) &&
      factors_.at(result).named == std::vector<int>{result}) {
    try {
      ConstantFactors both{exact_product(factors(x).exact, factors(y).exact), factors(x).named};
      const std::vector<int> others = factors(y).named;
      both.named.insert(both.named.end(), others.begin(), others.end());
      std::sort(both.named.begin(), both.named.end());
      if (both.named.size() <= 16) {
        factors_[result] = both;
      }
    } catch (const NotCovered&) {
      // It is a constant of its own.
    }
  }
  return result;
}

int LinearFrame::quotient(int x, int y) {
  return product(x, function("reciprocal", y));
}

LinearValue LinearFrame::value_of_function(const std::string& name, int x) {
  const LinearValue operand = at(x);
  require_plain(operand);
  const FrameFunction& f = frame_function(name);
  const Ball b = base(operand);
  LinearValue result;
  result.constant = f.value(b);
  if (!operand.deviations.empty()) {
    add_deviations(result, operand, f.slope(b));
    const std::size_t source = add_input(
        {nullptr, {x}, [f, b](const std::vector<Ball>& bounds) { return remainder_of(f, b, bounds.at(0)); }});
    result.deviations[source] = {one, zero};
  }
  return result;
}

int LinearFrame::function(const std::string& name, int x) {
  return made(name + " " + std::to_string(x), [&] { return value_of_function(name, x); });
}

}  // namespace veritrack::checker
