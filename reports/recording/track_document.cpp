#include "reports/recording/track_document.hpp"

#include <fmt/format.h>

#include "certificates/document/markdown_text.hpp"
#include "reports/recording/assumption_list.hpp"
#include "reports/recording/chi_square.hpp"
#include "reports/recording/track_blocks.hpp"
#include "reports/recording/track_sentences.hpp"

namespace veritrack::reports {

namespace {

namespace markdown = certificates::markdown;

constexpr std::size_t kRanges = 20;

std::string bullets(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) {
    text += "- " + sentence + "\n";
  }
  return text;
}

std::string recording_section(const TrackResult& result) {
  std::string text = "## What the recording shows\n\n";
  if (result.recording.empty()) {
    return text +
           "No DC offset, harmonics, hum, clipping, silence, dropouts, gaps, coarse steps, drift of the "
           "amplitude or "
           "sweep beyond the slew was found. docs/recordings.md says from what size on each is seen.\n\n";
  }
  std::vector<std::vector<std::string>> rows;
  for (const Finding& each : result.recording) {
    rows.push_back({each.name, listed(each.where, kRanges), each.sees, each.remedy});
  }
  return text + markdown::table({"", "samples", "what is seen", "remedy"}, rows) +
         "\nAmplitudes are in the units of the recording, numbers for the design file in those of the "
         "design. In white noise, each test of a fitted tone errs in fewer than one of a million blocks.\n\n";
}

std::string nis_section(const TrackReport& report) {
  const TrackResult& result = report.result;
  if (!result.has_innovation) {
    return "## Innovations\n\nThis tracker is given by its recursion: it has no covariance, so there are no "
           "innovations to normalise.\n\n";
  }
  std::string text = "## Innovations\n\n" + nis_sentence(result) + "\n\n";
  if (result.nis.count > 0) {
    const double freedom = static_cast<double>(result.window) * result.channels;
    text += fmt::format(
        "Stretches of {} samples whose mean NIS is above {:.4g}, which happens to a right belief with a "
        "probability of 3e-7: {}. The largest NIS of a sample is {:.4g}.\n\n",
        result.window, result.channels * mean_square_quantile(freedom, kNormalFive),
        listed(result.nis.too_large, kRanges), result.nis.largest);
  }
  return text;
}

std::string run_section(const TrackReport& report, const RecordingUnits& units) {
  const TrackResult& result = report.result;
  std::vector<std::string> sentences;
  sentences.push_back(fmt::format(
      "The recording is {}; {} samples from {} on were used{}.", markdown::escaped(report.recording),
      result.samples, units.sample(result.first),
      report.sample_rate ? fmt::format(", at {:.8g} samples per second", *report.sample_rate) : ""));
  for (const std::string& note : report.notes) {
    sentences.push_back(note);
  }
  if (result.scale != 1.0) {
    sentences.push_back(fmt::format("Samples were multiplied by {:.6g}.", result.scale));
  }
  for (const TrackStart& start : result.starts) {
    sentences.push_back(fmt::format(
        "The tracker was started at {} in the state in which it has followed a tone of amplitude {:.4g} and "
        "frequency {} for long; amplitude and phase are those of the samples from there on.",
        units.sample(start.sample), start.tone.amplitude, units.frequency(start.tone.frequency)));
  }
  if (result.start_count > result.starts.size()) {
    sentences.push_back(fmt::format("It was started {} times in all.", result.start_count));
  }
  sentences.push_back(fmt::format("Missing samples: {}.", listed(result.gaps, kRanges)));
  sentences.push_back(fmt::format("Samples without a tracker: {}.", listed(result.untracked, kRanges)));
  return "## The run\n\n" + bullets(sentences) + "\n";
}

std::string lock_section(const TrackReport& report) {
  const TrackResult& result = report.result;
  return fmt::format(
      "## Lock\n\nThe lock indicator is the share of the power of the last {} samples that is in a tone "
      "which "
      "turns with the estimated frequency: 1 for a tone without noise, SNR/(1 + SNR) in white noise. Below "
      "{} the tracker is out of lock. Out of lock: {}.\n\n",
      result.window, kLockShare, listed(result.no_lock, kRanges));
}

}  // namespace

std::string headline(const TrackReport& report) {
  const RecordingUnits units(report.sample_rate);
  if (!report.result.blocks.empty()) {
    std::string text = block_lock_sentence(report.result, units) + " " + assumptions_sentence(report) + " " +
                       findings_sentence(report.result);
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
  }
  const std::string hilbert = hilbert_excludes_certificate(report)
                                  ? "The Gaussian certificate does not apply: after the Hilbert filter, "
                                    "noise is neither independent from sample "
                                    "to sample nor from channel to channel. "
                                  : "";
  std::string text = hilbert + lock_sentence(report.result, units) + " " + assumptions_sentence(report) +
                     " " + bias_sentence(report.result, units) + findings_sentence(report.result) +
                     short_nis_sentence(report.result);
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::string to_markdown(const TrackReport& report, const std::string& figure,
                        const std::string& blocks_figure) {
  const RecordingUnits units(report.sample_rate);
  const TrackResult& result = report.result;
  std::string text = "# " + headline(report) + "\n\n";
  text += fmt::format("{}, tracker {}, on {}. Nothing on this page is proved.\n\n",
                      markdown::escaped(report.design->name), markdown::escaped(report.design->tracker),
                      markdown::escaped(report.recording));
  // A tracker in blocks is for tones that are too weak in single samples to be judged there.
  const bool in_blocks = !result.blocks.empty();
  text += in_blocks ? "" : bullets(report_sentences(report, units)) + "\n";
  if (!figure.empty()) {
    text += fmt::format("![Estimated frequency{}lock over the recording]({})\n\n",
                        result.has_innovation ? ", normalised innovations and " : " and ", figure);
  }
  text += recording_section(result) + assumptions_section(report);
  text += in_blocks ? blocks_section(report, blocks_figure) + run_section(report, units)
                    : lock_section(report) + nis_section(report) + run_section(report, units);
  text += fmt::format(
      "## Files\n\n`track.csv` has {} rows, each for {}. `veritrack track --each FILE` writes a row for "
      "every "
      "sample. The columns are\nexplained in docs/recordings.md.\n",
      result.series.rows().size(),
      result.series.samples_per_row() == 1 ? "one sample"
                                           : fmt::format("{} samples", result.series.samples_per_row()));
  return text;
}

}  // namespace veritrack::reports
