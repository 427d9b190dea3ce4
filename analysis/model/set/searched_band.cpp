#include "analysis/model/set/searched_band.hpp"

#include <fmt/format.h>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

using rigor::Interval;

SearchedBand searched_band(const Interval& band, std::size_t channels) {
  SearchedBand searched{band.lower(), band.upper(), {}};
  constexpr double kRoundedPi = 3.142;  // somebody may write pi with a few digits
  if (!(band.lower() >= 0.0) || !(band.upper() <= kRoundedPi) || !(band.lower() < band.upper())) {
    return {};
  }
  const bool is_one = channels == 1;
  const double margin = (band.upper() - band.lower()) / 256.0;
  if (!(band.lower() > 0.0)) {
    searched.low = margin;
    searched.out_of_reach.push_back(fmt::format(
        "out of reach between 0 and {:.4g} rad/sample: {}", margin,
        is_one ? "at 0 the samples are constant, and one channel does not tell the amplitude from "
                 "the phase: there is no steady state to settle in"
               : "at 0 the phase stands still, and the search for a steady state needs one that "
                 "turns"));
  }
  if (!rigor::certainly_less(Interval(band.upper()), rigor::pi())) {
    searched.high = rigor::pi().lower() - margin;
    searched.out_of_reach.push_back(fmt::format(
        "out of reach above {:.6g} rad/sample: {}", searched.high,
        is_one ? "at pi, half the sample rate, the samples of one channel only change their sign, "
                 "and do not tell the amplitude from the phase: there is no steady state to "
                 "settle in"
               : "frequencies above pi, half the sample rate, cannot be distinguished from lower ones"));
  }
  return searched;
}

}  // namespace veritrack::model
