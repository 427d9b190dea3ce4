#include "checker/model/false_lock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace veritrack::checker {

namespace {

/// More than enough to tell any locks apart.
constexpr long kMostOfATurn = 1'000'000;

long capped(long value) {
  return std::min(value, kMostOfATurn);
}

/// Whether a sample certainly changes at each of these phases; halves are looked at one by one where the
/// whole is too wide.
bool moves_on(const TrackedModel& model, const Ball& from, const Ball& to, int halvings) {
  const Jet<Ball> phase = Jet<Ball>::variable(Ball::hull(from, to), 0, 1);
  const std::vector<Jet<Ball>> samples = model.recursion->signal(Jet<Ball>(model.amplitude), phase);
  const bool moves = std::any_of(samples.begin(), samples.end(), [](const Jet<Ball>& sample) {
    return certainly_positive(abs(sample.slope(0)));
  });
  const Ball middle = ((from + to) * half).middle();
  return moves || (halvings > 0 && moves_on(model, from, middle, halvings - 1) &&
                   moves_on(model, middle, to, halvings - 1));
}

/// |Y'| > 0 at all phases: a signal that runs backwards has the same samples only if it turns back somewhere.
bool moves_on(const TrackedModel& model) {
  constexpr int kHalvings = 16;
  return moves_on(model, zero, (two * pi()).upper(), kHalvings);
}

}  // namespace

Repeats::Repeats(const Ball& value) {
  const double near = value.near();
  // cannot bind (value, near): a number close to a whole one would count as one, and the resulting distance
  // would be shorter.
  if (certainly_equal(value, Ball(near)) && std::floor(near) == near && std::abs(near) <= 1000.0) {
    whole_ = std::labs(static_cast<long>(near));
  }
}

Repeats Repeats::variable(std::size_t index, std::size_t count) {
  Repeats result(0.5);
  result.multiples_.assign(count, 0);
  result.multiples_.at(index) = 1;
  result.numerator_ = 1;
  return result;
}

long Repeats::parts() const {
  return capped(numerator_ + denominator_);
}

long Repeats::multiple() const {
  return multiples_.empty() ? 0 : *std::max_element(multiples_.begin(), multiples_.end());
}

std::vector<long> Repeats::multiples(const Repeats& x, const Repeats& y) {
  std::vector<long> result(std::max(x.multiples_.size(), y.multiples_.size()), 0);
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = capped((i < x.multiples_.size() ? x.multiples_[i] : 0) +
                       (i < y.multiples_.size() ? y.multiples_[i] : 0));
  }
  return result;
}

Repeats operator+(const Repeats& x, const Repeats& y) {
  Repeats result(0.5);
  result.multiples_ = Repeats::multiples(x, y);
  result.is_linear_ = x.is_linear_ && y.is_linear_;
  result.numerator_ = capped(std::max(x.numerator_ + y.denominator_, y.numerator_ + x.denominator_));
  result.denominator_ = capped(x.denominator_ + y.denominator_);
  return result;
}

Repeats operator*(const Repeats& x, const Repeats& y) {
  if (x.whole_ == 0 || y.whole_ == 0) {
    return Repeats(zero);  // a limit that is shown elsewhere adds 0 times its value
  }
  Repeats result(0.5);
  const long factor = std::max(1L, x.whole_.value_or(y.whole_.value_or(1)));
  result.multiples_ = Repeats::multiples(x, y);
  for (long& each : result.multiples_) {
    each = capped(each * factor);
  }
  result.is_linear_ = (x.is_constant() && y.is_linear_) || (y.is_constant() && x.is_linear_);
  result.numerator_ = capped(x.numerator_ + y.numerator_);
  result.denominator_ = capped(x.denominator_ + y.denominator_);
  return result;
}

Repeats operator/(const Repeats& x, const Repeats& y) {
  Repeats upside_down = y;
  upside_down.is_linear_ = y.is_constant();
  std::swap(upside_down.numerator_, upside_down.denominator_);
  return x * upside_down;
}

Repeats Repeats::function() const {
  Repeats result(0.5);
  for (const long each : multiples_) {
    result.multiples_.push_back(std::min(each, 1L));
  }
  result.is_linear_ = is_constant();
  result.numerator_ = result.denominator_ = parts();
  return result;
}

Repeats Repeats::periodic(long denominator) const {
  Repeats result(0.5);
  result.is_linear_ = is_constant();
  result.numerator_ = capped(multiple() + (is_linear_ ? 0 : 2 * parts()));
  result.denominator_ = denominator * result.numerator_;
  return result;
}

namespace {

/// The largest degree of the formulas of the next state; for a filter, of its model, its derivatives and its
/// measurement.
long degree_of_step(const ModelRecursion& recursion) {
  long most = 1;
  const auto count = [&](const std::vector<Repeats>& values) {
    for (const Repeats& value : values) {
      most = std::max(most, value.parts());
    }
  };
  const bool is_filter = recursion.filtered() > 0;
  const std::size_t n = is_filter ? recursion.filtered() : recursion.states();
  std::vector<Repeats> state;
  for (std::size_t i = 0; i < n; ++i) {
    state.push_back(Repeats::variable(i, n));
  }
  const std::vector<Repeats> samples(recursion.samples(), Repeats(0.5));
  if (!is_filter) {
    count(recursion.next(state, samples));
    return most;
  }
  const auto parts = recursion.filter_parts(state, samples);
  count(parts.predicted);
  count(parts.innovation);
  for (const auto& rows : {parts.jacobian, parts.measured}) {
    std::for_each(rows.begin(), rows.end(), count);
  }
  return most;
}

}  // namespace

Ball half_distance_to_false_lock(const TrackedModel& model, const Ball& lowest, const Ball& highest) {
  const ModelRecursion& recursion = *model.recursion;
  std::vector<Repeats> state;
  for (std::size_t i = 0; i < recursion.states(); ++i) {
    state.push_back(Repeats::variable(i, recursion.states()));
  }
  const Repeats frequency = recursion.frequency(state);
  long degree = std::max(degree_of_step(recursion), frequency.parts());
  degree = capped(degree * std::max(1L, frequency.multiple()));
  long harmonics = 1;
  for (const Repeats& sample : recursion.signal(Repeats(0.5), Repeats::variable(0, 1))) {
    harmonics = std::max(harmonics, sample.parts());
  }
  Ball distance = pi() / Ball(static_cast<double>(std::max(degree, harmonics)));
  if (!moves_on(model)) {
    distance = min(distance, min(lowest, pi() - highest));
  }
  if (harmonics > 1) {
    distance = min(distance, lowest / Ball(2.0 * static_cast<double>(harmonics)));
  }
  return distance.lower();
}

}  // namespace veritrack::checker
