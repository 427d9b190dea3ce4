#include "reports/recording/assumption_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reports/recording/track_sentences.hpp"

namespace veritrack::reports {

namespace {

using Outcome = TestedAssumption::Outcome;

constexpr std::size_t kListedRanges = 20;

/// The assumptions of one report.
class List {
 public:
  explicit List(const TrackReport& report)
      : report_(report),
        found_(report.result.assumptions),
        assume_(report.assume),
        units_(report.sample_rate) {}

  [[nodiscard]] std::vector<TestedAssumption> all() {
    add_signal();
    add_amplitude();
    add_measured("frequency",
                 fmt::format("from {} to {}", units_.frequency(assume_.frequency[0]),
                             units_.frequency(assume_.frequency[1])),
                 fmt::format("from {} to {}", units_.frequency(found_.frequency.least),
                             units_.frequency(found_.frequency.largest)),
                 found_.frequency_exceeded);
    add_slew();
    assume_.noise_deviation ? add_gaussian_noise() : add_bounded_noise();
    add_samples();
    rows_.push_back({"start", fmt::format("{}", fmt::join(assume_.start, "; ")), "", Outcome::not_testable,
                     "the run starts in the state in which the tracker has followed this tone for long"});
    return std::move(rows_);
  }

 private:
  [[nodiscard]] bool is_gaussian() const { return assume_.noise_deviation.has_value(); }

  void add_measured(const std::string& name, const std::string& assumed, const std::string& seen,
                    const SampleRanges& exceeded) {
    if (found_.judged == 0) {
      rows_.push_back({name, assumed, "", Outcome::not_testable, why_none_judged(report_.result)});
      return;
    }
    rows_.push_back({name, assumed, seen, exceeded.count() > 0 ? Outcome::not_kept : Outcome::kept,
                     exceeded.count() > 0 ? listed(exceeded, kListedRanges) : std::string()});
  }

  void add_signal() {
    std::vector<std::string> names;
    std::vector<std::string> where;
    for (const Finding& each : report_.result.recording) {
      if (each.is_signal && each.name != "amplitude drift") {
        names.push_back(each.name);
        where.push_back(each.name + ": " + listed(each.where, kListedRanges));
      }
    }
    const Waveform waveform(assume_.signal, report_.result.channels);
    const std::string assumed = waveform.is_tone() ? "a tone alone" : "the signal of the design file";
    if (!is_gaussian()) {
      // Anything else counts as noise, and may be within the bound.
      const bool is_beyond = found_.noise_exceeded.count() > 0 && !names.empty();
      const std::string seen = fmt::format("{}", fmt::join(names, ", "));
      rows_.push_back({"signal", assumed + ", and noise within its bound", seen,
                       found_.judged == 0 ? Outcome::not_testable
                       : is_beyond        ? Outcome::not_kept
                                          : Outcome::kept,
                       found_.judged == 0 ? why_none_judged(report_.result)
                       : is_beyond        ? fmt::format("{}", fmt::join(where, "; "))
                       : names.empty()    ? ""
                                          : "counts as noise, and is within the bound"});
      return;
    }
    const bool is_judged = found_.judged > 0 || !names.empty();
    rows_.push_back(
        {"signal", assumed + ", and Gaussian noise", fmt::format("{}", fmt::join(names, ", ")),
         !names.empty() ? Outcome::not_kept
         : is_judged    ? Outcome::kept
                        : Outcome::not_testable,
         is_judged ? fmt::format("{}", fmt::join(where, "; ")) : why_none_judged(report_.result)});
  }

  void add_amplitude() {
    const std::string assumed =
        amplitude_words(assume_) + (assume_.amplitude_varies ? ", of each sample" : ", constant");
    const std::string seen =
        fmt::format("from {:.4g} to {:.4g}", found_.amplitude.least, found_.amplitude.largest);
    const auto drift = std::find_if(report_.result.recording.begin(), report_.result.recording.end(),
                                    [](const Finding& each) { return each.name == "amplitude drift"; });
    if (is_gaussian() || assume_.amplitude[0] < assume_.amplitude[1]) {
      const bool is_drift = !assume_.amplitude_varies && drift != report_.result.recording.end();
      add_measured(
          "amplitude", assumed, seen,
          found_.amplitude_exceeded.count() == 0 && is_drift ? drift->where : found_.amplitude_exceeded);
      return;
    }
    if (found_.judged == 0) {
      rows_.push_back({"amplitude", assumed, "", Outcome::not_testable, why_none_judged(report_.result)});
      return;
    }
    const bool is_other = found_.amplitude_exceeded.count() > 0;
    const bool is_beyond = is_other && found_.noise_exceeded.count() > 0;
    rows_.push_back({"amplitude", assumed, seen, is_beyond ? Outcome::not_kept : Outcome::kept,
                     is_beyond  ? listed(found_.amplitude_exceeded, kListedRanges)
                     : is_other ? "another amplitude counts as noise, and is within the bound"
                                : ""});
  }

  void add_slew() {
    if (!assume_.slew) {
      rows_.push_back({"steps of the frequency", "a Gaussian random walk", "", Outcome::not_testable,
                       fmt::format("a frequency is estimated over {} samples, which shows no single step",
                                   report_.result.window)});
      return;
    }
    const auto sweep = std::find_if(report_.result.recording.begin(), report_.result.recording.end(),
                                    [](const Finding& each) { return each.is_slew; });
    const bool is_seen = found_.slew_exceeded.count() == 0 && sweep != report_.result.recording.end();
    if (is_seen && found_.judged == 0) {
      rows_.push_back({"slew", "at most " + units_.slew(*assume_.slew), sweep->sees, Outcome::not_kept,
                       listed(sweep->where, kListedRanges)});
      return;
    }
    add_measured("slew", "at most " + units_.slew(*assume_.slew),
                 fmt::format("largest {} ± {:.1g} between stretches of {} samples; root mean square {:.2g}",
                             units_.slew(found_.largest_slew), found_.slew_deviation, report_.result.window,
                             found_.slew_root_mean_square),
                 is_seen ? sweep->where : found_.slew_exceeded);
  }

  void add_bounded_noise() {
    const double bound = assume_.noise.value_or(NAN);
    add_measured(
        "noise",
        fmt::format("at most {:.4g}{}, the distance from a tone of amplitude {}", bound,
                    report_.result.channels > 1 ? ", both channels together" : "", amplitude_words(assume_)),
        fmt::format("largest {:.4g}; root mean square of each channel {:.4g}", found_.largest_distance,
                    found_.distance_deviation),
        found_.noise_exceeded);
    rows_.push_back(
        {"noise, outside of the samples judged", fmt::format("at most {:.4g}, for ever", bound), "",
         Outcome::not_testable,
         found_.judged == 0
             ? std::string(why_none_judged(report_.result))
             : fmt::format("a recording shows the deviation, {:.3g}, and not the bound, of noise to come",
                           found_.distance_deviation)});
  }

  void add_gaussian_noise() {
    add_measured("noise deviation",
                 fmt::format("a deviation of at most {:.4g} in each channel", *assume_.noise_deviation),
                 fmt::format("{:.4g}", found_.distance_deviation), found_.noise_exceeded);
    rows_.push_back({"Gaussian noise", "in every sample", "", Outcome::not_testable,
                     "the probability of losing lock rests on values too rare for a recording"});
    const bool is_derived = report_.result.quadrature_is_derived;
    const Outcome outcome = is_derived ? Outcome::not_kept : Outcome::not_testable;
    rows_.push_back({"independent noise", "from sample to sample", "", outcome,
                     is_derived
                         ? "all samples: the Hilbert filter makes each from many"
                         : "the fit takes a part of the noise, and what it leaves is not white by itself"});
    if (report_.result.channels > 1) {
      rows_.push_back({"independent noise", "from channel to channel", "", outcome,
                       is_derived ? "all samples: the Hilbert filter makes one channel from the other"
                                  : "uncorrelated noise need not be independent"});
    }
  }

  void add_samples() {
    const TrackResult& result = report_.result;
    std::int64_t missing = 0;
    std::vector<std::string> where;
    for (const Finding& each : result.recording) {
      if (each.is_missing) {
        missing += each.where.samples();
        where.push_back(each.name + ": " + listed(each.where, kListedRanges));
      }
    }
    rows_.push_back({"samples", "every sample arrives",
                     fmt::format("{} of {} are missing or stand for none", missing, result.samples),
                     missing > 0 ? Outcome::not_kept : Outcome::kept,
                     fmt::format("{}", fmt::join(where, "; "))});
    if (assume_.samples) {
      const bool is_within = static_cast<double>(result.samples) <= *assume_.samples;
      rows_.push_back({"samples", fmt::format("at most {:.0f} after the start", *assume_.samples),
                       fmt::format("{}", result.samples), is_within ? Outcome::kept : Outcome::not_kept,
                       is_within ? "" : fmt::format("from sample {:.0f} on", *assume_.samples)});
    }
  }

  const TrackReport& report_;
  const AssumptionFindings& found_;
  const certificates::SignalAssumptions& assume_;
  RecordingUnits units_;
  std::vector<TestedAssumption> rows_;
};

}  // namespace

std::vector<TestedAssumption> tested_assumptions(const TrackReport& report) {
  return List(report).all();
}

bool hilbert_excludes_certificate(const TrackReport& report) {
  return report.result.quadrature_is_derived && report.assume.noise_deviation.has_value();
}

bool keeps_to_tested(const TrackReport& report) {
  const std::vector<TestedAssumption> rows = tested_assumptions(report);
  return report.result.assumptions.judged > 0 &&
         std::none_of(rows.begin(), rows.end(),
                      [](const TestedAssumption& each) { return each.outcome == Outcome::not_kept; });
}

}  // namespace veritrack::reports
