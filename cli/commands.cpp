#include "cli/commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <functional>

#include "certificates/design/design_reader.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/coq_document.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/document/output_files.hpp"
#include "certificates/document/tuning.hpp"
#include "reports/certificate_files.hpp"
#include "reports/check_reports.hpp"
#include "reports/example_report.hpp"
#include "reports/limit_report.hpp"
#include "reports/tracker_reports.hpp"

namespace veritrack::cli {

namespace {

/// 0 when everything required is PROVED, or nothing is required; else 1.
ExitStatus status_of(const certificates::Certificate& certificate) {
  const bool fine = !certificate.verdict || *certificate.verdict == rigor::Verdict::proved;
  return fine ? all_proved : not_proved;
}

/// A progress line on standard error for long work, if standard error is a terminal and --quiet is not given.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) != 0) {}
  ~ProgressLine() {
    if (shown_) {
      fmt::print(stderr, "\r\033[K");
    }
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ProgressLine(ProgressLine&&) = delete;
  ProgressLine& operator=(ProgressLine&&) = delete;

  void operator()(const certificates::Progress& progress) const {
    if (shown_) {
      fmt::print(stderr, "\rproved {:5.1f} %, refuted {:5.1f} % ({} propagations)",
                 100.0 * progress.proved_share, 100.0 * progress.refuted_share, progress.propagations);
    }
  }

 private:
  bool shown_;
};

certificates::Certificate certify_with_progress(const std::string& design_path, bool quiet) {
  const ProgressLine line(quiet);
  return certificates::certify_file(design_path, std::cref(line));
}

}  // namespace

ExitStatus run_certify(const CertifyOptions& options) {
  certificates::Certificate certificate = certify_with_progress(options.design, options.quiet);
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

ExitStatus run_check(const CheckOptions& options) {
  ExitStatus status = all_proved;
  std::vector<reports::CheckedDesign> checked;
  for (const std::string& path : options.designs) {
    checked.push_back({path, certify_with_progress(path, options.quiet)});
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
                   claim.requirement, claim.reason);
      }
    }
    if (status_of(certificate) != all_proved) {
      status = not_proved;
    }
  }
  return status;
}

ExitStatus run_map(const MapOptions& options) {
  const certificates::Design design = certificates::read_design_file(options.design);
  std::string directory = options.directory;
  if (directory.empty()) {
    directory = (std::filesystem::path("maps-out") / std::filesystem::path(options.design).stem()).string();
  }
  const reports::MapResult result = [&] {
    const ProgressLine line(options.quiet);
    return reports::write_map(design, options.request, directory, std::cref(line));
  }();
  if (!result.picture) {
    fmt::print("{}: undecided: {}\n", options.design, result.sentence);
    return not_proved;
  }
  fmt::print("{}: {}\n", result.picture->string(), result.sentence);
  return all_proved;
}

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

}  // namespace veritrack::cli
