#include "reports/recording/track_sentences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "reports/recording/assumption_list.hpp"
#include "reports/recording/chi_square.hpp"

namespace veritrack::reports {

namespace {

using NisVerdict = NisFindings::Verdict;

/// How many times as large the squared innovations are as the filter believes.
double innovation_ratio(const TrackResult& result) {
  return result.nis.sum / static_cast<double>(result.nis.count) / result.channels;
}

/// The estimate less the frequency of the recording's tone, rad/sample: of one that is steady, by the long
/// stretches in which the recording was examined, which tell it from its harmonics; of another, by the fits
/// in lock.
double bias_of(const TrackResult& result) {
  constexpr double kSteady = 5e-3;
  const Spread& tone = result.recorded_frequency;
  const bool is_steady = tone.count > 0 && tone.largest - tone.least < kSteady * std::fabs(tone.mean());
  return is_steady ? result.frequency.mean() - tone.mean() : result.assumptions.bias;
}

/// A difference between estimate and fit that is no chance, and that counts.
bool is_biased(const TrackResult& result) {
  constexpr double kDeviations = 5.0;
  constexpr double kCounts = 1e-3;
  const double bias = std::fabs(bias_of(result));
  return result.assumptions.judged > 0 && bias > kDeviations * result.assumptions.bias_deviation &&
         bias > kCounts * std::fabs(result.frequency.mean());
}

/// "DC offset, harmonics": what is wrong with the signal.
std::string names_of(const std::vector<Finding>& findings) {
  std::vector<std::string> names;
  names.reserve(findings.size());
  for (const Finding& each : findings) {
    names.push_back(each.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
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
  const std::string frequency =
      "; the estimate is " + units.frequency(result.frequency.mean()) + " on average";
  if (!result.lost_lock) {
    return fmt::format("Kept lock{}{}.", result.has_gap_between ? ", apart from gaps" : "", frequency);
  }
  return fmt::format("Lost lock at {}{}{}.", units.sample(*result.lost_lock),
                     result.ends_in_lock ? ", and found it again" : "", frequency);
}

std::string bias_sentence(const TrackResult& result, const RecordingUnits& units) {
  if (!is_biased(result)) {
    return {};
  }
  const double bias = bias_of(result);
  return fmt::format(
      "The estimate is {} {} the frequency of the tone fitted to the recording, {}: a bias of the "
      "tracker{}. ",
      units.frequency(std::fabs(bias)), bias > 0.0 ? "above" : "below",
      units.frequency(result.frequency.mean() - bias),
      result.recording.empty() ? std::string() : " on this recording (" + names_of(result.recording) + ")");
}

std::string findings_sentence(const TrackResult& result) {
  return result.recording.empty() ? std::string()
                                  : "Seen in the recording: " + names_of(result.recording) + ". ";
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
  if (verdict == NisVerdict::over_confident && !result.recording.empty()) {
    return fmt::format(
        "Over-confident: {}. Squared innovations are {:.3g} times as large as the filter believes. The "
        "recording has {}: "
        "correct that first, and then judge R and Q.",
        numbers, ratio, names_of(result.recording));
  }
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

std::vector<std::string> report_sentences(const TrackReport& report, const RecordingUnits& units) {
  const TrackResult& result = report.result;
  const AssumptionFindings& found = result.assumptions;
  std::vector<std::string> sentences;
  if (result.first_lock) {
    sentences.push_back(fmt::format(
        "In lock at {} of {} samples, from {} on; there the estimated frequency is {} on average, from {} to "
        "{}.",
        result.in_lock, result.samples, units.sample(*result.first_lock),
        units.frequency(result.frequency.mean()), units.frequency(result.frequency.least),
        units.frequency(result.frequency.largest)));
  }
  if (result.assumptions.judged > 0 && result.first_lock) {
    sentences.push_back(fmt::format(
        "The tone fitted to the recording has a frequency of {} on average: the estimate is {} by {} ± "
        "{:.1g} rad/sample.",
        units.frequency(result.frequency.mean() - bias_of(result)),
        bias_of(result) >= 0.0 ? "above it" : "below it", units.frequency(std::fabs(bias_of(result))),
        found.bias_deviation));
  }
  if (result.no_number) {
    sentences.push_back(
        fmt::format("At {} the estimate was no finite number; the tracker was not run until the next gap.",
                    units.sample(*result.no_number)));
  }
  if (result.has_innovation) {
    sentences.push_back(nis_sentence(result));
  }
  if (!keeps_to_tested(report) && found.judged > 0) {
    sentences.emplace_back(
        "A certificate of this design says nothing of the samples in which an assumption is not kept, and of "
        "those after "
        "them. The table of the assumptions has them.");
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
