#include "analysis/model/set/amplitude_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "analysis/model/steady_state/steady_state.hpp"
#include "analysis/model/tube/tube_proposal.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

/// The reasons why nothing was proved for parts; neighbours with equal reasons are reported together.
class FailedParts {
 public:
  void add(std::string reason, const AmplitudeRange& part) {
    for (Failure& failure : failures_) {
      if (failure.reason == reason && failure.range.high == part.low) {
        failure.range.high = part.high;
        return;
      }
    }
    failures_.push_back({std::move(reason), part});
  }
  [[nodiscard]] std::vector<std::string> reasons() const {
    const rigor::NearestRounding nearest;
    std::vector<std::string> texts;
    texts.reserve(failures_.size());
    for (const auto& [reason, range] : failures_) {
      texts.push_back(fmt::format("at amplitudes from {:.6g} to {:.6g}: {}", range.low, range.high, reason));
    }
    return texts;
  }

 private:
  struct Failure {
    std::string reason;
    AmplitudeRange range;
  };
  std::vector<Failure> failures_;
};

}  // namespace

std::vector<AmplitudeRange> equal_parts(const rigor::Interval& range, std::size_t count) {
  const rigor::NearestRounding nearest;
  if (count == 0 || !rigor::is_finite(range) || !(range.lower() < range.upper())) {
    throw std::invalid_argument("no range of amplitudes, or no parts");
  }
  // A little more at both ends, so that another reading of their decimals is inside.
  constexpr double kMore = 0x1p-40;
  const double from = range.lower() * (1.0 - std::copysign(kMore, range.lower()));
  const double to = std::min(range.upper() * (1.0 + std::copysign(kMore, range.upper())),
                             std::numeric_limits<double>::max());
  std::vector<AmplitudeRange> parts;
  for (std::size_t k = 0; k < count; ++k) {
    const double low = parts.empty() ? from : parts.back().high;
    const double share = static_cast<double>(k + 1) / static_cast<double>(count);
    const double high = k + 1 == count ? to : from + (to - from) * share;
    if (!(low < high) || !(high <= to)) {
      throw std::invalid_argument("more parts than doubles can tell");
    }
    parts.push_back({low, high});
  }
  return parts;
}

std::size_t parts_of_range(const ToneAtAmplitude& tone_at, const rigor::Interval& range, double low,
                           double high, const search::Deadline& deadline) {
  const rigor::NearestRounding nearest;
  constexpr double kShare = 0.125;  // of the noise; a radius loses a few hundredths then
  constexpr double kNarrow = 1e-3;  // of the band: one frequency, about
  const double width = range.upper() - range.lower();
  double widest = width;
  const auto decide_at = [&](double amplitude, double frequency) {
    TubeSettings settings;
    settings.shape.objective = ShapeObjective::largest_noise;
    settings.shape.deadline = deadline;
    settings.steady_state.deadline = deadline;
    const TubeProposal proposal =
        propose_tube(tone_at(amplitude, 0.0), frequency, kNarrow * (high - low), settings);
    const double noise = proposal.tube ? proposal.worth.noise : 0.0;
    const double of_width = error_from_amplitude(tone_at(amplitude, 0.5 * width));
    if (noise > 0.0 && std::isfinite(noise) && of_width > 0.0) {
      widest = std::min(widest, kShare * noise / of_width * width);
    }
  };
  for (const double amplitude : {range.lower(), range.upper()}) {
    for (const double place : {0.01, 0.5, 0.99}) {
      if (!deadline.is_over()) {
        decide_at(amplitude, low + place * (high - low));
      }
    }
  }
  const double count = std::ceil(width / widest);
  return count >= 1.0 && count <= static_cast<double>(kMostAmplitudeParts) ? static_cast<std::size_t>(count)
                                                                           : kMostAmplitudeParts;
}

TubeSet join_amplitudes(std::vector<TubeSet> sets, const std::vector<AmplitudeRange>& parts) {
  if (sets.empty() || sets.size() != parts.size()) {
    throw std::invalid_argument("a set for each part of the amplitudes");
  }
  TubeSet all;
  all.name = sets.front().name;
  all.noise = sets.front().noise;
  all.slew = sets.front().slew;
  all.part = sets.front().part;
  all.is_complete = true;
  bool is_any = true;
  FailedParts failures;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    TubeSet& set = sets[k];
    all.noise = std::min(all.noise, set.noise);
    all.slew = std::min(all.slew, set.slew);
    all.part = {std::max(all.part.low, set.part.low), std::min(all.part.high, set.part.high)};
    all.is_complete = all.is_complete && set.is_complete;
    is_any = is_any && !set.tubes.empty();
    for (std::string& reason : set.reasons) {
      failures.add(std::move(reason), parts[k]);
    }
    AmplitudePart part{parts[k].low,         parts[k].high, all.tubes.size(), 0, std::move(set.crossing),
                       set.covariance_margin};
    std::move(set.tubes.begin(), set.tubes.end(), std::back_inserter(all.tubes));
    part.end = all.tubes.size();
    all.amplitudes.push_back(std::move(part));
  }
  all.reasons = failures.reasons();
  if (!is_any || !(all.part.low < all.part.high)) {
    all.is_complete = false;
    all.tubes.clear();
    all.amplitudes.clear();
    return all;
  }
  all.parts = {all.part};
  return all;
}

std::vector<TubeSet> sets_of_amplitudes(const TubeSet& set) {
  if (set.amplitudes.empty()) {
    return {set};
  }
  std::vector<TubeSet> sets;
  for (const AmplitudePart& part : set.amplitudes) {
    TubeSet one;
    one.name = set.name;
    one.noise = set.noise;
    one.slew = set.slew;
    one.is_complete = set.is_complete;
    one.part = set.part;
    one.parts = set.parts;
    one.crossing = part.crossing;
    one.covariance_margin = part.covariance_margin;
    one.tubes.assign(set.tubes.begin() + static_cast<std::ptrdiff_t>(part.first),
                     set.tubes.begin() + static_cast<std::ptrdiff_t>(part.end));
    one.amplitudes = {part};
    one.amplitudes.front().first = 0;
    one.amplitudes.front().end = one.tubes.size();
    sets.push_back(std::move(one));
  }
  return sets;
}

TrackerModel on_amplitudes_of(TrackerModel model, const TubeSet& set) {
  if (set.amplitudes.size() > 1) {
    throw std::invalid_argument("a set of several parts of the amplitudes");
  }
  for (const AmplitudePart& part : set.amplitudes) {
    model.amplitude = rigor::Interval::from_bounds(part.low, part.high);
    model.amplitude_varies = true;
  }
  return model;
}

}  // namespace veritrack::model
