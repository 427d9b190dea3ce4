#include "certificates/model/loop_verdicts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/linear/loop_margins.hpp"
#include "analysis/linear/mode_damping.hpp"
#include "analysis/model/gain/linear_loop.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr double kRoomForChecker = 1e-6;

Interval with_room(const Interval& x) {
  return x * (Interval(1.0) + Interval(kRoomForChecker));
}
Interval without_room(const Interval& x) {
  return x * (Interval(1.0) - Interval(kRoomForChecker));
}

/// At least this: PROVED with a little more, REFUTED with a little less.
template <typename Decide>
Verdict least_with_room(const Interval& least, const Decide& decide) {
  return decide(with_room(least)) == Verdict::proved       ? Verdict::proved
         : decide(without_room(least)) == Verdict::refuted ? Verdict::refuted
                                                           : Verdict::undecided;
}

/// The largest number of a few digits, near to the proposed one, with which it is proved; or empty.
template <typename Decide>
std::string largest_proved(double proposed, const Decide& decide) {
  constexpr int kDigits = 4;
  for (const double share : {1.0 - kRoomForChecker, 0.999, 0.99, 0.9}) {
    if (!std::isfinite(proposed) || !(proposed > 0.0)) {
      break;
    }
    std::string text = rigor::to_decimal(share * proposed, kDigits, rigor::Direction::down);
    const Interval value = rigor::parse_decimal(text);
    if (rigor::certainly_positive(value) && decide(value) == Verdict::proved) {
      return text;
    }
  }
  return "";
}

/// Entries that the checker may know less exactly.
linear::DetectorLoop with_room(const linear::DetectorLoop& loop) {
  return {linear::with_room(loop.a), linear::with_room(loop.effect), linear::with_room(loop.phase)};
}

double proposed_damping(const model::LoopNetwork& network) {
  double smallest = 1.0;
  for (const linear::LoopMode& mode : linear::modes_of(model::linear_loop(network))) {
    smallest = std::min(smallest, mode.damping);
  }
  return smallest;
}

Interval gain_of(const Interval& decibels) {
  return exp(decibels / Interval(20.0) * log(Interval(10.0)));
}

/// In dB; that of a factor of 1000 where there is no limit.
double proposed_margin(const linear::DetectorLoop& loop) {
  constexpr double kNoLimit = 60.0;
  const double high = linear::gain_margin(loop).high;
  return std::isfinite(high) ? 20.0 * std::log10(high) : kNoLimit;
}

}  // namespace

LoopVerdict damping_verdict(const model::LoopNetwork& network, const Interval& least) {
  const auto decide = [a = linear::with_room(network.a)](const Interval& damping) {
    return rigor::certainly_less(damping, Interval(1.0)) ? linear::has_damping(a, damping)
                                                         : Verdict::undecided;
  };
  return {least_with_room(least, decide), largest_proved(proposed_damping(network), decide)};
}

LoopVerdict gain_margin_verdict(const linear::DetectorLoop& loop, const Interval& decibels) {
  const auto decide = [crude = with_room(loop)](const Interval& margin) {
    return linear::is_stable_up_to(crude, gain_of(margin));
  };
  return {least_with_room(decibels, decide), largest_proved(proposed_margin(loop), decide)};
}

Verdict time_constant_verdict(const linear::RadiusBounds& radius, const Interval& samples) {
  const auto shrinking = [](const Interval& time) { return exp(Interval(-1.0) / time); };
  const linear::RadiusBounds crude = linear::with_room(radius);
  return rigor::certainly_less(Interval(crude.upper), shrinking(without_room(samples))) ? Verdict::proved
         : rigor::certainly_less(shrinking(with_room(samples)), Interval(crude.lower))  ? Verdict::refuted
                                                                                        : Verdict::undecided;
}

Verdict bandwidth_verdict(const linear::DetectorLoop& loop, const Interval& required) {
  const std::optional<Interval> bandwidth = linear::noise_bandwidth(with_room(loop));
  return !bandwidth                                                  ? Verdict::undecided
         : rigor::certainly_less(with_room(*bandwidth), required)    ? Verdict::proved
         : rigor::certainly_less(required, without_room(*bandwidth)) ? Verdict::refuted
                                                                     : Verdict::undecided;
}

}  // namespace veritrack::certificates
