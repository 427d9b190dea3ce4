// The command line: reads arguments, calls certificates/ and reports/, prints, and chooses the exit status.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/rigor/self_test.hpp"
#include "certificates/certificate.hpp"
#include "certificates/coq_document.hpp"
#include "certificates/design_reader.hpp"
#include "certificates/markdown.hpp"
#include "certificates/output_files.hpp"
#include "certificates/region.hpp"
#include "certificates/tuning.hpp"
#include "reports/certificate_files.hpp"
#include "reports/check_reports.hpp"
#include "reports/example_report.hpp"
#include "reports/limit_report.hpp"
#include "reports/region_files.hpp"

namespace {

namespace certificates = veritrack::certificates;
namespace reports = veritrack::reports;
namespace rigor = veritrack::rigor;

enum ExitStatus : int { all_proved = 0, not_proved = 1, bad_input = 2, bad_arithmetic = 3 };

/// 0 when everything required is PROVED, or nothing is required; else 1.
ExitStatus status_of(const certificates::Certificate& certificate) {
  const bool fine = !certificate.verdict || *certificate.verdict == rigor::Verdict::proved;
  return fine ? all_proved : not_proved;
}

/// A line on standard error that follows long work, when a person is watching.
bool show_progress(const veritrack::contraction::RegionProgress& progress) {
  if (isatty(STDERR_FILENO) != 0) {
    fmt::print(stderr, "\rproved {:5.1f} %, refuted {:5.1f} % ({} propagations)",
               100.0 * progress.proved_share, 100.0 * progress.refuted_share, progress.propagations);
  }
  return true;
}

/// Takes that line away.
void end_progress() {
  if (isatty(STDERR_FILENO) != 0) {
    fmt::print(stderr, "\r\033[K");
  }
}

certificates::Certificate certify_with_progress(const std::string& design_path) {
  certificates::Certificate certificate = certificates::certify_file(design_path, show_progress);
  end_progress();
  return certificate;
}

struct CertifyOptions {
  std::string design;
  std::string directory;
  bool coq = false;
};

ExitStatus run_certify(const CertifyOptions& options) {
  certificates::Certificate certificate = certify_with_progress(options.design);
  if (options.coq) {
    certificate.formal_proofs = certificates::coq_proofs(certificate);
  }
  std::string directory = options.directory;
  if (directory.empty()) {
    directory =
        (std::filesystem::path("certificates-out") / std::filesystem::path(options.design).stem()).string();
  }
  const std::filesystem::path document = reports::write_certificate_files(certificate, directory);
  fmt::print("{}: {}\n", document.string(), certificates::headline(certificate));
  return status_of(certificate);
}

struct CheckOptions {
  std::vector<std::string> designs;
  std::string junit;
  std::string sarif;
};

ExitStatus run_check(const CheckOptions& options) {
  ExitStatus status = all_proved;
  std::vector<reports::CheckedDesign> checked;
  for (const std::string& path : options.designs) {
    checked.push_back({path, certify_with_progress(path)});
  }
  certificates::OutputFiles files;
  if (!options.junit.empty()) {
    files.stage(options.junit, reports::to_junit(checked));
  }
  if (!options.sarif.empty()) {
    files.stage(options.sarif, reports::to_sarif(checked));
  }
  files.commit();
  for (const auto& [path, certificate] : checked) {
    if (!certificate.verdict) {
      fmt::print("{}: nothing required\n", path);
    }
    for (const certificates::Claim& claim : certificate.claims) {
      if (claim.required) {
        fmt::print("{}:{}: {}: {} ({})\n", path, claim.position.line, rigor::to_string(claim.verdict),
                   claim.statement, claim.reason);
      }
    }
    if (status_of(certificate) != all_proved) {
      status = not_proved;
    }
  }
  return status;
}

struct MapOptions {
  std::string design;
  std::string directory;
  certificates::RegionRequest request;
};

ExitStatus run_map(const MapOptions& options) {
  const certificates::Design design = certificates::read_design_file(options.design);
  const certificates::RegionResult result =
      certificates::prove_region_of_attraction(design, options.request, show_progress);
  end_progress();
  if (!result.found) {
    fmt::print("{}: undecided: {}\n", options.design, result.reason);
    return not_proved;
  }
  std::string directory = options.directory;
  if (directory.empty()) {
    directory = (std::filesystem::path("maps-out") / std::filesystem::path(options.design).stem()).string();
  }
  const std::filesystem::path picture = reports::write_region_files(*result.found, directory);
  fmt::print("{}: {:.1f} % of the simulated basin is proved to be captured, {} cells\n", picture.string(),
             100.0 * result.found->shares.proved, result.found->region.cells.size());
  return all_proved;
}

struct TuneOptions {
  std::string design;
  std::string output;
};

ExitStatus run_tune(const TuneOptions& options) {
  const certificates::TuningResult result =
      certificates::tune(certificates::read_design_file(options.design));
  if (!result.design_text) {
    fmt::print("{}: undecided: {}\n", options.design, result.reason);
    return not_proved;
  }
  std::string output = options.output;
  if (output.empty()) {
    output = std::filesystem::path(options.design).stem().string() + "-tuned.toml";
  }
  certificates::OutputFiles files;
  files.stage(output, *result.design_text);
  files.commit();
  const certificates::Certificate certificate = certificates::certify_file(output);
  fmt::print("{}: {}\n", output, certificates::headline(certificate));
  return status_of(certificate);
}

constexpr const char* kExampleReport = "bittanti-savaresi-2000";
constexpr const char* kLimitReport = "tracking-limits";

struct ReproduceOptions {
  std::string report = kExampleReport;
  std::string directory;
  int seeds = 0;  ///< 0: as many as the report in docs/reports was made with
};

ExitStatus run_reproduce(const ReproduceOptions& options) {
  const std::filesystem::path directory = options.directory.empty()
                                              ? std::filesystem::path("reports-out") / options.report
                                              : std::filesystem::path(options.directory);
  const bool limits = options.report == kLimitReport;
  const int published_seeds = limits ? 1000 : 200;
  const int seeds = options.seeds > 0 ? options.seeds : published_seeds;
  const std::filesystem::path document = limits ? reports::write_limit_report(seeds, directory)
                                                : reports::write_example_report(seeds, directory);
  fmt::print("{}\n", document.string());
  return all_proved;
}

int run(int argc, char** argv) {
  CLI::App app{"Machine-checked certificates for frequency trackers.", "veritrack"};
  app.set_version_flag("--version", std::string("veritrack ") + VERITRACK_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 everything required is PROVED (or nothing is required); 1 something is REFUTED or "
      "UNDECIDED;\n"
      "2 bad input; 3 this machine's arithmetic failed the self-test.");

  CertifyOptions certify_options;
  CLI::App* certify =
      app.add_subcommand("certify", "write certificate.md, certificate.json and figures for a design");
  certify->add_option("DESIGN", certify_options.design, "design file (TOML)")->required();
  certify->add_option("--out", certify_options.directory,
                      "folder for the certificate (default: certificates-out/<name of the design file>)");
  certify->add_flag("--coq", certify_options.coq,
                    "also write certificate.v, proofs that the proof assistant Coq can check (make proofs)");

  CheckOptions check_options;
  CLI::App* check =
      app.add_subcommand("check", "the same verdicts without the documents: a line per requirement");
  check->add_option("DESIGN", check_options.designs, "design files (TOML)")->required();
  check->add_option("--junit", check_options.junit, "also write the verdicts as JUnit XML");
  check->add_option("--sarif", check_options.sarif, "also write what is not PROVED as SARIF 2.1.0");

  MapOptions map_options;
  CLI::App* map =
      app.add_subcommand("map", "draw the proved region of attraction over start frequency and phase error");
  map->add_option("DESIGN", map_options.design, "design file (TOML), without leak")->required();
  map->add_option("--out", map_options.directory,
                  "folder for the map (default: maps-out/<name of the design file>)");
  map->add_option("--frequency", map_options.request.frequency_error,
                  "largest start frequency error, rad/sample")
      ->check(CLI::Range(1e-6, 4.0))
      ->capture_default_str();
  map->add_option("--phase", map_options.request.phase_error, "largest start phase error, rad")
      ->check(CLI::Range(1e-6, 3.1))
      ->capture_default_str();
  map->add_flag("--noise", map_options.request.with_noise,
                "with the noise and slew of [assume]; otherwise without any");

  TuneOptions tune_options;
  CLI::App* tune = app.add_subcommand(
      "tune",
      "choose the filter rates of a KKL observer for a small frequency error, and certify the result");
  tune->add_option("DESIGN", tune_options.design, "design file (TOML), tracker kkl-observer")->required();
  tune->add_option("--out", tune_options.output,
                   "design file to write (default: <name of the design file>-tuned.toml)");

  ReproduceOptions reproduce_options;
  CLI::App* reproduce = app.add_subcommand("reproduce",
                                           "make a report of docs/reports anew: the published examples of "
                                           "the single-channel tracker, or how close "
                                           "the trackers come to the Cramer-Rao bounds");
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
    return app.exit(error) == 0 ? all_proved : bad_input;
  }

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
  if (map->parsed()) {
    return run_map(map_options);
  }
  if (tune->parsed()) {
    return run_tune(tune_options);
  }
  if (reproduce->parsed()) {
    return run_reproduce(reproduce_options);
  }
  return certify->parsed() ? run_certify(certify_options) : run_check(check_options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  }
}
