#include "reports/recording/track_sentences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/recording/chi_square.hpp"

namespace veritrack::reports {

namespace {

using NisVerdict = NisFindings::Verdict;

/// How many times as large the squared innovations are as the filter believes.
double innovation_ratio(const TrackResult& result) {
  return result.nis.sum / static_cast<double>(result.nis.count) / result.channels;
}

/// What of the assumptions is exceeded: "noise, slew".
std::vector<std::string> exceeded(const AssumptionFindings& found) {
  std::vector<std::string> names;
  const auto add = [&](const SampleRanges& ranges, const char* name) {
    if (ranges.count() > 0) {
      names.emplace_back(name);
    }
  };
  add(found.noise_exceeded, "noise");
  add(found.slew_exceeded, "slew");
  add(found.frequency_exceeded, "frequency");
  return names;
}

}  // namespace

std::string amplitude_words(const certificates::SignalAssumptions& assume) {
  const auto& [least, largest] = assume.amplitude;
  return least == largest ? fmt::format("{:.6g}", least) : fmt::format("{:.6g} to {:.6g}", least, largest);
}

std::string lock_sentence(const TrackResult& result, const RecordingUnits& units) {
  if (result.samples == 0) {
    return "The recording has no samples.";
  }
  if (!result.first_lock) {
    return result.start_count == 0 ? "The tracker was never started." : "The tracker was never in lock.";
  }
  if (!result.lost_lock) {
    return result.has_gap_between ? "Kept lock, apart from gaps." : "Kept lock.";
  }
  return fmt::format("Lost lock at {}{}.", units.sample(*result.lost_lock),
                     result.ends_in_lock ? ", and found it again" : "");
}

std::string nis_sentence(const TrackResult& result) {
  const NisVerdict verdict = verdict_on(result.nis, result.channels);
  if (verdict == NisVerdict::none || verdict == NisVerdict::too_few) {
    return "Too few samples were in lock to judge the innovations.";
  }
  const auto count = static_cast<double>(result.nis.count);
  const double channels = result.channels;
  const std::string numbers = fmt::format(
      "the normalised innovation squared (NIS) is {:.4g} on average; {} {} expected, with 95 % between "
      "{:.4g} "
      "and {:.4g} over {} samples",
      result.nis.sum / count, result.channels, result.channels > 1 ? "are" : "is",
      channels * mean_square_quantile(channels * count, -kNormal975),
      channels * mean_square_quantile(channels * count, kNormal975), result.nis.count);
  if (verdict == NisVerdict::consistent) {
    return "Consistent: " + numbers + ".";
  }
  const double ratio = innovation_ratio(result);
  if (verdict == NisVerdict::over_confident) {
    return fmt::format(
        "Over-confident: {}. Squared innovations are {:.3g} times as large as the filter believes; its R or "
        "Q "
        "is too small for this recording.",
        numbers, ratio);
  }
  return fmt::format(
      "Cautious: {}. Squared innovations are {:.3g} times as large as the filter believes; its R or Q is "
      "larger than this recording needs.",
      numbers, ratio);
}

std::string short_nis_sentence(const TrackResult& result) {
  switch (verdict_on(result.nis, result.channels)) {
    case NisVerdict::consistent:
      return "NIS within its chi-squared band. ";
    case NisVerdict::over_confident:
      return fmt::format("Over-confident: NIS {:.3g} times what is expected. ", innovation_ratio(result));
    case NisVerdict::cautious:
      return fmt::format("Cautious: NIS {:.3g} times what is expected. ", innovation_ratio(result));
    default:
      return {};
  }
}

std::string assumptions_sentence(const TrackResult& result) {
  const AssumptionFindings& found = result.assumptions;
  if (found.judged == 0) {
    return "Whether the recording keeps to what the certificate assumes could not be judged.";
  }
  if (found.keeps()) {
    return "As far as estimates can tell, the recording keeps to what the certificate assumes.";
  }
  return fmt::format("The recording exceeds what the certificate assumes: {}.",
                     fmt::join(exceeded(found), ", "));
}

std::vector<std::string> report_sentences(const TrackReport& report, const RecordingUnits& units) {
  const TrackResult& result = report.result;
  std::vector<std::string> sentences;
  if (result.first_lock) {
    sentences.push_back(fmt::format(
        "In lock at {} of {} samples, from {} on; there the estimated frequency is {} on average, from {} to "
        "{}.",
        result.in_lock, result.samples, units.sample(*result.first_lock),
        units.frequency(result.frequency.mean()), units.frequency(result.frequency.least),
        units.frequency(result.frequency.largest)));
  }
  if (result.no_number) {
    sentences.push_back(
        fmt::format("At {} the estimate was no finite number; the tracker was not run until the next gap.",
                    units.sample(*result.no_number)));
  }
  if (result.has_innovation) {
    sentences.push_back(nis_sentence(result));
  }
  const AssumptionFindings& found = result.assumptions;
  if (!found.keeps()) {
    sentences.emplace_back(
        "A certificate of this design says nothing of the samples in which the recording exceeds what it "
        "assumes, and of those after them. The table below has them.");
  }
  constexpr double kFar = 1.2;
  Extent amplitude = found.amplitude;
  if (amplitude.is_empty && !result.starts.empty()) {
    amplitude.add(result.starts.front().tone.amplitude);
  }
  if (!amplitude.is_empty && (amplitude.largest * kFar < report.assume.amplitude[0] ||
                              amplitude.least > kFar * report.assume.amplitude[1])) {
    sentences.push_back(
        fmt::format("The tone has an amplitude from {:.3g} to {:.3g}, and the design assumes {}: use --scale "
                    "auto, or a factor.",
                    amplitude.least, amplitude.largest, amplitude_words(report.assume)));
  }
  return sentences;
}

}  // namespace veritrack::reports
