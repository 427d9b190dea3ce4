// The command line: reads arguments and calls commands.hpp.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/self_test.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/design/nearest_key.hpp"
#include "certificates/document/code_language.hpp"
#include "cli/commands.hpp"
#include "cli/standard_output.hpp"

namespace {

using namespace veritrack::cli;  // NOLINT(google-build-using-namespace): this file is made of it
namespace rigor = veritrack::rigor;

/// What to say when the first argument that is no option is no command; empty when it is one.
std::string unknown_command(CLI::App& app, int argc, char** argv) {
  const auto arguments = std::span(argv, static_cast<std::size_t>(argc));
  const auto first = std::find_if(arguments.begin() + 1, arguments.end(),
                                  [](const char* argument) { return *argument != '-'; });
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) {
    known.push_back(command->get_name());
  }
  if (first == arguments.end() || std::find(known.begin(), known.end(), *first) != known.end()) {
    return {};
  }
  constexpr std::size_t kShown = 100;
  return fmt::format("veritrack: no command is called \"{}\"; nearest command: {}; allowed: {}",
                     veritrack::certificates::printable(*first, kShown),
                     veritrack::certificates::nearest_key(*first, known), fmt::join(known, ", "));
}

int run(int argc, char** argv) {
  CLI::App app{"Machine-checked certificates for frequency trackers.", "veritrack"};
  app.set_version_flag("--version", std::string("veritrack ") + VERITRACK_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 everything required is PROVED (or nothing is required); 1 something is REFUTED or "
      "UNDECIDED;\n"
      "2 bad input, or an output that cannot be written; 3 this machine's arithmetic cannot be trusted.");

  bool quiet = false;
  app.add_flag("--quiet", quiet, "no progress on standard error");
  app.fallthrough();

  CertifyOptions certify_options;
  CLI::App* certify =
      app.add_subcommand("certify", "write certificate.md, certificate.json and figures for a design");
  certify->add_option("DESIGN", certify_options.design, "design file (TOML)")->required();
  certify->add_option("--out", certify_options.directory,
                      "folder for the certificate (default: certificates-out/<name of the design file>)");
  certify->add_flag("--coq", certify_options.coq,
                    "also write certificate.v, proofs that the proof assistant Coq can check (make proofs)");

  // Not CLI::Range, which lets pass what is not a number.
  const auto seconds = [](const std::string& text) {
    const double value = rigor::nearest_double(text);
    return value >= 1e-3 && value <= 1e8 ? std::string()
                                         : std::string("allowed: a number of seconds from 0.001 to 1e8");
  };
  certify
      ->add_option("--timeout", certify_options.seconds,
                   "end the search of a design with tracker model after so many seconds, and write what is "
                   "proved by then")
      ->check(seconds);

  CheckOptions check_options;
  CLI::App* check =
      app.add_subcommand("check", "the same verdicts without the documents, one line per requirement");
  check->add_option("DESIGN", check_options.designs, "design files (TOML), or folders of them")->required();
  check->add_option("--jobs", check_options.jobs, "designs at a time (default: one for each core)")
      ->check(CLI::Range(1, 1024));
  check->add_flag("!--no-cache", check_options.cache,
                  "check again what this program has checked before (docs/ci.md)");
  check->add_option("--json", check_options.json, "also write the verdicts as JSON");
  check->add_option("--junit", check_options.junit, "also write the verdicts as JUnit XML");
  check->add_option("--sarif", check_options.sarif, "also write what is not PROVED as SARIF 2.1.0");

  check
      ->add_option("--timeout", check_options.seconds,
                   "stop each design after so many seconds: what is not decided by then is UNDECIDED")
      ->check(seconds);
  check->add_flag("--strict", check_options.strict, "a design that requires nothing is 1, not 0");

  DiffOptions diff_options;
  CLI::App* diff = app.add_subcommand("diff", "what is better or worse in one certificate than in another");
  diff->add_option("OLD", diff_options.before, "design file (TOML), certificate.json, or its folder")
      ->required();
  diff->add_option("NEW", diff_options.after, "likewise")->required();
  diff->add_option("--tolerance", diff_options.tolerance, "relative changes up to this count as none")
      ->check([](const std::string& text) {
        const double value = rigor::nearest_double(text);
        return value >= 0.0 && value < 1.0 ? std::string() : std::string("allowed: a number from 0, below 1");
      })
      ->capture_default_str();

  MapOptions map_options;
  CLI::App* map = app.add_subcommand("map", "draw the proved region of attraction: which starts lock");
  map->add_option(
         "DESIGN", map_options.design,
         "design file (TOML), tracker quadrature-ekf without leak, or model with at most four states")
      ->required();
  map->add_option("--out", map_options.directory,
                  "folder for the map (default: maps-out/<name of the design file>)");
  map->add_option("--frequency", map_options.request.frequency_error,
                  "quadrature-ekf: largest start frequency error, rad/sample (default 1)")
      ->check(CLI::Range(1e-6, 4.0));
  map->add_option("--phase", map_options.request.phase_error,
                  "quadrature-ekf: largest start phase error, rad (default 1.5)")
      ->check(CLI::Range(1e-6, 3.1));
  map->add_option("--at", map_options.request.at,
                  "model: frequency of the signal, rad/sample (default: the middle of the assumed band)");
  map->add_option("--x", map_options.request.x,
                  "model: a state that deviates at the start (default: an angle, or the first one)");
  map->add_option("--y", map_options.request.y,
                  "model: another one (default: the state that the frequency is read from)");
  map->add_option("--x-range", map_options.request.x_range,
                  "model: by how much at most (default: ten times what the certified set allows)")
      ->check(CLI::Range(1e-300, 1e300));
  map->add_option("--y-range", map_options.request.y_range, "model: likewise")
      ->check(CLI::Range(1e-300, 1e300));
  map->add_option("--cells", map_options.request.cells, "model: cells in each direction (default 21)")
      ->check(CLI::Range(1, 200));
  map->add_flag("--noise", map_options.request.with_noise,
                "with the noise of [assume], for quadrature-ekf with its slew, too; otherwise without any");

  ShowOptions show_options;
  CLI::App* show = app.add_subcommand(
      "show", "print the recursion of a tracker that is given as a model, or code that computes the same");
  show->add_option("DESIGN", show_options.design, "design file (TOML), tracker model")->required();
  show->add_option("--language", show_options.language, "in which language")
      ->check(CLI::IsMember(veritrack::certificates::code_language_names()))
      ->capture_default_str();

  TuneOptions tune_options;
  CLI::App* tune = app.add_subcommand(
      "tune",
      "choose the filter rates of a KKL observer for a small frequency error, and certify the result");
  tune->add_option("DESIGN", tune_options.design, "design file (TOML), tracker kkl-observer")->required();
  tune->add_option("--out", tune_options.output,
                   "design file to write (default: <name of the design file>-tuned.toml)");

  TrackOptions track_options;
  CLI::App* track = app.add_subcommand("track", "run the tracker of a design over a recording");
  track->add_option("DESIGN", track_options.design, "design file (TOML)")->required();
  track->add_option("RECORDING", track_options.recording, "CSV or sound file; - is standard input")
      ->required();
  track->add_option("--out", track_options.directory,
                    "folder for track.md, track.csv and track.svg (default: tracks-out/<name of the "
                    "recording>)");
  track->add_option("--each", track_options.each,
                    "also write a row of CSV for every sample to this file; - is standard output");
  track
      ->add_option("--format", track_options.format,
                   "what the recording is: csv, sound, or auto (by content; standard input is CSV)")
      ->check(CLI::IsMember({"auto", "csv", "sound"}))
      ->capture_default_str();
  track
      ->add_option("--columns", track_options.columns,
                   "of CSV: the channel, or in phase and quadrature with a comma, by name or number")
      ->delimiter(',')
      ->expected(1, 2);
  track->add_option("--time", track_options.time, "of CSV: the column with seconds, or none");
  track->add_option("--sample-rate", track_options.sample_rate, "Hz, in place of what the recording says")
      ->check(CLI::Range(1e-9, 1e15));
  track->add_option("--channel", track_options.channel, "of a sound file: the channel to use, from 1")
      ->check(CLI::Range(1, 64));
  track->add_flag("--quadrature", track_options.quadrature,
                  "of a sound file: channels 1 and 2 are in phase and quadrature");
  track
      ->add_option("--scale", track_options.scale,
                   "what samples are multiplied by; auto: so that the tone has the assumed amplitude")
      ->capture_default_str();
  track->add_option("--from", track_options.from, "the first sample to use, from 0")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 60));
  track->add_option("--to", track_options.to, "the sample to stop before")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 60));
  track
      ->add_option("--start-frequency", track_options.start_frequency,
                   "where the tracker starts, rad/sample (default: the tone that is found)")
      ->check(CLI::Range(1e-9, 3.15));
  track->add_option("--start-hz", track_options.start_hertz, "the same in Hz")->check(CLI::Range(1e-9, 1e15));
  track->add_flag("--strict", track_options.strict,
                  "1 when lock is lost or the recording exceeds what the certificate assumes");

  ReproduceOptions reproduce_options;
  CLI::App* reproduce =
      app.add_subcommand("reproduce",
                         "regenerate a report of docs/reports: the published examples of the single-channel "
                         "tracker, or the comparison of the trackers with the Cramer-Rao bounds");
  reproduce->add_option("REPORT", reproduce_options.report, "which report")
      ->check(CLI::IsMember({kExampleReport, kLimitReport}))
      ->capture_default_str();
  reproduce->add_option("--out", reproduce_options.directory,
                        "folder for the report (default: reports-out/<name of the report>)");
  reproduce->add_option("--seeds", reproduce_options.seeds, "noise seeds (default: those of docs/reports)")
      ->check(CLI::Range(1, 100000));

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string unknown = unknown_command(app, argc, argv); !unknown.empty()) {
      fmt::print(stderr, "{}\n", unknown);
      return bad_input;
    }
    return app.exit(error) == 0 ? all_proved : bad_input;
  }

  certify_options.quiet = check_options.quiet = map_options.quiet = track_options.quiet = diff_options.quiet =
      quiet;

  const rigor::SelfTestReport self_test = rigor::run_self_test();
  if (!self_test.passed()) {
    for (const std::string& failure : self_test.failures) {
      fmt::print(stderr, "veritrack: arithmetic self-test: {}\n", failure);
    }
    fmt::print(
        stderr,
        "veritrack: this machine or this build cannot be trusted with a certificate; nothing was computed\n");
    return bad_arithmetic;
  }
  if (diff->parsed()) {
    return run_diff(diff_options);
  }
  if (map->parsed()) {
    return run_map(map_options);
  }
  if (show->parsed()) {
    return run_show(show_options);
  }
  if (tune->parsed()) {
    return run_tune(tune_options);
  }
  if (track->parsed()) {
    return run_track(track_options);
  }
  if (reproduce->parsed()) {
    return run_reproduce(reproduce_options);
  }
  return certify->parsed() ? run_certify(certify_options) : run_check(check_options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    prepare_standard_streams();
    const int status = run(argc, argv);
    finish_standard_output();
    return status;
  } catch (const rigor::RoundingModeError& error) {
    fmt::print(stderr, "veritrack: {}; nothing that was computed can be trusted\n", error.what());
    return bad_arithmetic;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  }
}
