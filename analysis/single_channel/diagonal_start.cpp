#include "analysis/single_channel/diagonal_start.hpp"

#include <algorithm>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::single_channel {

using rigor::Interval;

StartVariances DiagonalStart::times(const std::string& multiple, const Interval& amplitude) const {
  const Interval factor = rigor::parse_decimal(multiple);
  return {factor * rigor::parse_decimal(signal) / square(amplitude),
          factor * rigor::parse_decimal(frequency)};
}

std::optional<double> level_of(const DiagonalStart& start, const StartBox& box, const Interval& amplitude) {
  const StartVariances lowest = start.times(start.from, amplitude);
  if (!certainly_positive(lowest.signal) || !certainly_positive(lowest.frequency)) {
    return std::nullopt;
  }
  return sqrt(square(Interval(box.signal)) / lowest.signal +
              square(Interval(box.frequency)) / lowest.frequency)
      .upper();
}

StartBox shape_of(const StartBox& box) {
  // No variance may vanish.
  constexpr double kLeastShare = 1e-3;
  const double least = kLeastShare * std::max(box.signal, box.frequency);
  return least > 0.0 ? StartBox{std::max(box.signal, least), std::max(box.frequency, least)}
                     : StartBox{1.0, 1.0};
}

DiagonalStart diagonal_start(const StartProposal& start, const StartBox& box, double margin,
                             double amplitude) {
  constexpr int kDigits = 5;
  constexpr double kLargestMultiple = 1.05;
  const StartBox shape = shape_of(box);
  const double room = kLargestMultiple * margin * margin * start.level * start.level;
  const auto decimal = [](double x) { return rigor::to_decimal(x, kDigits, rigor::Direction::down); };
  const double signal = shape.signal * amplitude;
  return {decimal(signal * signal / (room * start.weight)),
          decimal(shape.frequency * shape.frequency / (room * (1.0 - start.weight))), "0.95", "1.05"};
}

}  // namespace veritrack::single_channel
