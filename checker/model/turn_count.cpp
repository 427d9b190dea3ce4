#include "checker/model/turn_count.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace veritrack::checker {

namespace {

constexpr long kMostTurns = 1'000'000;

}  // namespace

TurnCount::TurnCount(const Ball& value) {
  const double near = value.near();
  if (certainly_equal(value, Ball(near)) && std::floor(near) == near && std::abs(near) <= 1000.0) {
    whole_ = static_cast<long>(near);
  }
}

TurnCount TurnCount::angle(std::size_t index, std::size_t count) {
  TurnCount result(zero);
  result.whole_.reset();
  result.turns_.assign(count, 0);
  result.turns_.at(index) = 1;
  return result;
}

TurnCount TurnCount::unknown() {
  TurnCount result(zero);
  result.whole_.reset();
  result.known_ = false;
  return result;
}

TurnCount TurnCount::still() {
  TurnCount result = unknown();
  result.known_ = true;
  return result;
}

bool TurnCount::turns_by(const std::vector<long>& expected) const {
  if (!known_) {
    return false;
  }
  const auto at = [](const std::vector<long>& list, std::size_t i) { return i < list.size() ? list[i] : 0; };
  for (std::size_t i = 0; i < std::max(turns_.size(), expected.size()); ++i) {
    if (at(turns_, i) != at(expected, i)) {
      return false;
    }
  }
  return true;
}

TurnCount TurnCount::combined(const TurnCount& x, long times_x, const TurnCount& y, long times_y) {
  TurnCount result = unknown();
  result.known_ = x.known_ && y.known_;
  result.turns_.assign(std::max(x.turns_.size(), y.turns_.size()), 0);
  for (std::size_t i = 0; i < result.turns_.size(); ++i) {
    result.turns_[i] =
        (i < x.turns_.size() ? times_x * x.turns_[i] : 0) + (i < y.turns_.size() ? times_y * y.turns_[i] : 0);
    result.known_ = result.known_ && std::labs(result.turns_[i]) <= kMostTurns;
  }
  return result;
}

TurnCount TurnCount::with(const TurnCount& y) const {
  TurnCount result = unknown();
  result.known_ = is_still() && y.is_still();
  return result;
}

TurnCount TurnCount::periodic() const {
  TurnCount result = unknown();
  result.known_ = known_;
  return result;
}

TurnCount operator*(const TurnCount& x, const TurnCount& y) {
  if (x.whole_) {
    return TurnCount::combined(y, *x.whole_, TurnCount(0.0), 0);
  }
  return y.whole_ ? TurnCount::combined(x, *y.whole_, TurnCount(0.0), 0) : x.with(y);
}

std::string angle_objection(const ModelRecursion& recursion) {
  const std::size_t n = recursion.states();
  std::vector<TurnCount> state;
  for (std::size_t i = 0; i < n; ++i) {
    state.push_back(recursion.is_angle()[i] ? TurnCount::angle(i, n) : TurnCount::still());
  }
  const std::vector<TurnCount> samples(recursion.samples(), TurnCount::still());
  const std::vector<TurnCount> next = recursion.next(state, samples);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<long> expected(n, 0);
    expected[i] = recursion.is_angle()[i] ? 1 : 0;
    if (!next.at(i).turns_by(expected)) {
      return "the next value of " + recursion.state_names()[i] +
             (recursion.is_angle()[i] ? " is not known to turn as the angle does"
                                      : " may depend on whole turns of an angle");
    }
  }
  if (!recursion.frequency(state).is_still()) {
    return "the frequency may depend on whole turns of an angle";
  }
  for (const TurnCount& sample : recursion.signal(TurnCount::still(), TurnCount::angle(0, 1))) {
    if (!sample.is_still()) {
      return "the signal is not known to have the period 2 pi";
    }
  }
  return {};
}

}  // namespace veritrack::checker
