#include "certificates/model/band_part.hpp"

#include "analysis/rigor/decimal.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Direction;
using rigor::Interval;

/// rad/sample in the unit of the band.
Interval in_band_unit(const ModelAssumptions& assume, double radians) {
  return assume.frequency_in_hertz ? FrequencyUnits(assume.sample_rate).in_hertz(Interval(radians))
                                   : Interval(radians);
}

}  // namespace

std::optional<BandPart> band_part(const ModelAssumptions& assume, const model::FrequencyRange& range) {
  const Interval band = band_of(assume);
  const Interval low = in_band_unit(assume, range.low);
  const Interval high = in_band_unit(assume, range.high);
  if (!rigor::is_finite(low) || !rigor::is_finite(high)) {
    return std::nullopt;
  }
  constexpr int kDigits = 6;
  BandPart part;
  part.from = range.low <= band.lower() ? assume.frequency[0].text
                                        : rigor::to_decimal(low.upper(), kDigits, Direction::up);
  part.to = range.high >= band.upper() ? assume.frequency[1].text
                                       : rigor::to_decimal(high.lower(), kDigits, Direction::down);
  const bool is_something =
      rigor::certainly_less(rigor::parse_decimal(part.from), rigor::parse_decimal(part.to));
  return is_something ? std::optional(part) : std::nullopt;
}

}  // namespace veritrack::certificates
