// veritrack track: a recording, the tracker of a design, and what comes of it.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "certificates/design/design_reader.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/document/output_target.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "cli/commands.hpp"
#include "cli/default_folder.hpp"
#include "reports/recording/assumption_list.hpp"
#include "reports/recording/findings/recording_examiner.hpp"
#include "reports/recording/fitting_source.hpp"
#include "reports/recording/samples/open_recording.hpp"
#include "reports/recording/samples/overheard_source.hpp"
#include "reports/recording/track_blocks.hpp"
#include "reports/recording/track_files.hpp"
#include "reports/recording/track_table.hpp"

namespace veritrack::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardInput = "standard input";

/// Thrown for options that do not go together.
[[noreturn]] void refuse_options(const std::string& message) {
  throw std::invalid_argument("veritrack track: " + message);
}

/// The factor; none for "auto".
std::optional<double> scale_of(const std::string& text) {
  if (text == "auto") {
    return std::nullopt;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (!is_number || !std::isfinite(value) || !(value > 0.0)) {
    refuse_options(
        fmt::format("--scale {}; allowed: auto, or a number above 0", certificates::printable(text, 40)));
  }
  return value;
}

reports::RecordingRequest request_of(const TrackOptions& options) {
  reports::RecordingRequest request;
  request.path = options.recording;
  request.format = options.format == "csv"     ? reports::RecordingFormat::csv
                   : options.format == "sound" ? reports::RecordingFormat::sound
                                               : reports::RecordingFormat::by_content;
  request.columns.channels = options.columns;
  request.columns.time = options.time;
  if (options.sample_rate > 0.0) {
    request.columns.sample_rate = options.sample_rate;
  }
  if (options.channel > 0) {
    request.sound.channel = options.channel;
  }
  request.sound.quadrature = options.quadrature;
  return request;
}

/// Throws certificates::OutputError when the output is an input.
void refuse_inputs(const std::string& output, const std::vector<fs::path>& inputs) {
  if (output == "-") {
    return;
  }
  const certificates::OutputTarget target = certificates::resolve_output(output);
  for (const fs::path& input : inputs) {
    if (certificates::is_file(target, input)) {
      throw certificates::OutputError(output, "it is an input of this command");
    }
  }
}

/// How far it is, on standard error, if that is a terminal.
class TrackProgress {
 public:
  TrackProgress(bool quiet, const reports::SampleSource& source)
      : shown_(!quiet && ::isatty(STDERR_FILENO) != 0), source_(&source) {}
  ~TrackProgress() {
    if (shown_) {
      fmt::print(stderr, "\r\033[K");
    }
  }
  TrackProgress(const TrackProgress&) = delete;
  TrackProgress& operator=(const TrackProgress&) = delete;
  TrackProgress(TrackProgress&&) = delete;
  TrackProgress& operator=(TrackProgress&&) = delete;

  void operator()(std::int64_t samples) const {
    if (shown_) {
      const std::optional<double> share = source_->progress();
      fmt::print(stderr, "\r{} samples{}", samples, share ? fmt::format(", {:5.1f} %", 100.0 * *share) : "");
    }
  }

 private:
  bool shown_;
  const reports::SampleSource* source_;
};

reports::TrackSettings settings_of(const TrackOptions& options, std::optional<double> sample_rate) {
  reports::TrackSettings settings;
  settings.from = options.from;
  if (options.to >= 0) {
    settings.to = options.to;
  }
  settings.scale = scale_of(options.scale);
  if (options.start_frequency > 0.0) {
    settings.start_frequency = options.start_frequency;
  }
  if (options.start_hertz > 0.0) {
    if (!sample_rate || options.start_frequency > 0.0) {
      refuse_options("--start-hz needs a sample rate (--sample-rate), and no --start-frequency");
    }
    settings.start_frequency = 2.0 * std::numbers::pi * options.start_hertz / *sample_rate;
  }
  return settings;
}

/// The rate that the options, the recording or the design say, in this order, and a sentence when recording
/// and design differ.
std::optional<double> sample_rate_of(const TrackOptions& options, const reports::SampleSource& source,
                                     const certificates::SignalAssumptions& assume,
                                     std::vector<std::string>& notes) {
  if (options.sample_rate > 0.0) {
    return options.sample_rate;
  }
  const std::optional<double> recorded = source.sample_rate();
  constexpr double kSame = 1e-3;
  if (recorded && assume.sample_rate && std::fabs(*recorded / *assume.sample_rate - 1.0) > kSame) {
    notes.push_back(
        fmt::format("The recording has {:.8g} samples per second, and the design assumes {:.8g}: frequencies "
                    "in rad/sample "
                    "agree, those in Hz are of the recording.",
                    *recorded, *assume.sample_rate));
  }
  return recorded ? recorded : assume.sample_rate;
}

/// The tracker of the design. Throws certificates::InputError for one that cannot be run.
certificates::TrackerOnSamples tracker_of(const certificates::Design& design, const std::string& file) {
  const certificates::TrackerKind& kind = certificates::kind_of(design);
  if (kind.track == nullptr) {
    const auto position = design.positions.find("tracker");
    throw certificates::InputError(
        file, position != design.positions.end() ? position->second : certificates::Position{},
        fmt::format("veritrack track cannot be used with the tracker {}; allowed: {}", design.tracker,
                    certificates::names_of_kinds([](const auto& each) { return each.track != nullptr; })));
  }
  try {
    return kind.track(design);
  } catch (const certificates::NotTrackable& error) {
    throw certificates::InputError(file, {}, error.what());
  }
}

/// Whether the tracker stays in lock once it is, and the recording violates no tested assumption.
bool is_fine(const reports::TrackReport& report) {
  const reports::TrackResult& result = report.result;
  return !result.blocks.empty() ? reports::blocks_are_in_lock(result)
                                : result.first_lock && !result.lost_lock && reports::keeps_to_tested(report);
}

}  // namespace

ExitStatus run_track(const TrackOptions& options) {
  const certificates::Design design = certificates::read_design_file(options.design);
  const bool is_stream = options.recording == "-";
  const fs::path recording = is_stream ? fs::path(kStandardInput) : fs::path(options.recording);
  const bool by_name = options.directory.empty();
  if (by_name && is_stream) {
    refuse_options("standard input has no name; allowed: --out FOLDER with it");
  }
  const fs::path directory = by_name ? default_folder("tracks-out", recording) : fs::path(options.directory);

  certificates::TrackerOnSamples tracker = tracker_of(design, options.design);
  auto heard = std::make_unique<reports::OverheardSource>(reports::open_recording(request_of(options)));
  reports::OverheardSource& overheard = *heard;
  const int recorded = std::min(heard->channels(), tracker.tracker->channels());
  reports::FittingSource source =
      reports::fit_channels(std::move(heard), tracker.tracker->channels(), tracker.assume);
  reports::TrackReport report;
  report.design = &design;
  report.recording = recording.filename().string();
  report.assume = tracker.assume;
  report.sample_rate = sample_rate_of(options, *source.samples, tracker.assume, report.notes);
  const reports::TrackSettings settings = settings_of(options, report.sample_rate);

  reports::RecordingExaminer examiner(tracker.assume, recorded, report.sample_rate);
  overheard.listen([&](std::int64_t index, const reports::RecordedSample& sample) {
    if (settings.from <= index && index < settings.to) {
      examiner.push(index, sample);
    }
  });

  std::vector<fs::path> inputs{options.design};
  if (!is_stream) {
    inputs.push_back(recording);
  }
  std::optional<reports::SampleTable> table;
  if (!options.each.empty()) {
    refuse_inputs(options.each, inputs);
    table.emplace(options.each, tracker.tracker->channels(), report.sample_rate);
  }
  {
    const TrackProgress progress(options.quiet, *source.samples);
    report.result = reports::track_recording(
        *source.samples, tracker, settings,
        [&](const reports::TrackedSample& sample) {
          if (table) {
            table->add(sample);
          }
        },
        std::cref(progress));
  }
  examiner.finish();
  report.result.recording = examiner.findings(report.result.scale);
  report.result.recorded_frequency = examiner.frequency();
  if (table) {
    table->finish();
  }
  if (!source.note.empty()) {
    report.notes.push_back(source.note);
  }
  for (std::string& note : source.samples->notes()) {
    report.notes.push_back(std::move(note));
  }
  const reports::TrackFiles files = reports::write_track_files(report, directory, inputs);
  if (by_name) {
    mark_folder(directory, recording);
  }
  if (!files.missing_figure.empty()) {
    fmt::print(stderr, "{}: written without its figure; {}\n", files.document.string(), files.missing_figure);
  }
  fmt::print(options.each == "-" ? stderr : stdout, "{}: {}\n", files.document.string(),
             reports::headline(report));
  return options.strict && !is_fine(report) ? not_proved : all_proved;
}

}  // namespace veritrack::cli
