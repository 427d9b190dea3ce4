#include "cli/commands.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/design/request_error.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/coq_document.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/document/tuning.hpp"
#include "cli/default_folder.hpp"
#include "cli/interruption.hpp"
#include "cli/progress_line.hpp"
#include "cli/verifier.hpp"
#include "reports/certificate_files.hpp"
#include "reports/tracker_reports.hpp"

namespace veritrack::cli {

namespace {

/// 0 when everything required is PROVED, or nothing is required; else 1.
ExitStatus status_of(const certificates::Certificate& certificate) {
  const bool fine = !certificate.verdict || *certificate.verdict == rigor::Verdict::proved;
  return fine ? all_proved : not_proved;
}

/// `seconds`: after which the search ends; 0: never.
certificates::Certificate certify_with_progress(const std::string& design_path, bool quiet,
                                                certificates::Extent extent, double seconds) {
  const search::Deadline deadline = seconds > 0.0 ? search::Deadline(seconds) : search::Deadline();
  certificates::Certificate certificate = [&] {
    const ProgressLine line(quiet, "certifying");
    return certificates::certify_file(design_path, std::cref(line), extent, deadline);
  }();
  if (seconds > 0.0 && !quiet && !certificates::kind_of(certificate.design).limited_in_time) {
    fmt::print(stderr, "{}: --timeout has no effect on the tracker {}; it can stop: {}\n", design_path,
               certificate.design.tracker,
               certificates::names_of_kinds([](const auto& kind) { return kind.limited_in_time; }));
  }
  return certificate;
}

/// Throws InputError: the design's tracker cannot do what the command is for.
[[noreturn]] void refuse_tracker(const std::string& path, const certificates::Design& design,
                                 const std::string& command, const std::string& able) {
  const auto position = design.positions.find("tracker");
  throw certificates::InputError(
      path, position != design.positions.end() ? position->second : certificates::Position{},
      fmt::format("veritrack {} cannot be used with the tracker {}; allowed: {}", command, design.tracker,
                  able));
}

}  // namespace

namespace {

/// The checker, unless it is not to be asked, or is not there, which is said.
std::optional<Verifier> verifier_for(const CertifyOptions& options) {
  try {
    return options.no_verify ? std::nullopt : std::optional<Verifier>(std::in_place);
  } catch (const NoVerifier& error) {
    fmt::print(stderr, "{}: will not be verified: {}\n", options.design, error.what());
    return std::nullopt;
  }
}

/// Asks the checker, and notes how many seconds it took.
certificates::Verification verify_with_progress(const Verifier& verifier, const reports::TextsToVerify& texts,
                                                bool quiet, double& seconds) {
  const ProgressLine line(quiet, "verifying");
  const auto start = std::chrono::steady_clock::now();
  certificates::Verification verification = verifier(texts);
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return verification;
}

}  // namespace

ExitStatus run_certify(const CertifyOptions& options) {
  const bool by_name = options.directory.empty();
  const std::filesystem::path directory =
      by_name ? default_folder("certificates-out", options.design) : std::filesystem::path(options.directory);
  const std::optional<Verifier> verifier = verifier_for(options);
  certificates::Certificate certificate =
      certify_with_progress(options.design, options.quiet, certificates::Extent::everything, options.seconds);
  if (options.coq) {
    certificate.formal_proofs = certificates::coq_proofs(certificate);
  }
  double seconds = 0.0;
  reports::Verify verify;
  if (verifier) {
    verify = [&](const reports::TextsToVerify& texts) {
      return verify_with_progress(*verifier, texts, options.quiet, seconds);
    };
  }
  const reports::CertificateFiles files =
      reports::write_certificate_files(certificate, directory, options.design, options.renderings, verify);
  if (by_name) {
    mark_folder(directory, options.design);
  }
  if (!files.missing_figures.empty()) {
    fmt::print(stderr, "{}: written without its figures; {}\n", files.document.string(),
               files.missing_figures);
  }
  if (certificate.formal_proofs && !options.quiet) {
    for (const std::string& sentence : certificate.formal_proofs->left_out) {
      fmt::print(stderr, "{}: {}\n", options.design, sentence);
    }
  }
  using Outcome = certificates::Verification::Outcome;
  const Outcome outcome = files.verification.outcome;
  fmt::print("{}: {}\n", files.document.string(), certificates::headline(certificate, files.verification));
  if (outcome == Outcome::verified) {
    fmt::print("VERIFIED by veritrack-verify in {:.1f} s\n", seconds);
  } else if (outcome == Outcome::refused) {
    fmt::print("NOT VERIFIED: {}\n", refusal_sentence(files.verification));
    return not_proved;
  } else if (verifier) {
    fmt::print(stderr, "{}: not verified: interrupted\n", options.design);
  }
  const ExitStatus status = status_of(certificate);
  if (status == not_proved && certificates::can_be_tuned(certificate.design) && !options.quiet) {
    fmt::print(stderr, "{}: veritrack tune looks for design values that meet what is required\n",
               options.design);
  }
  return status;
}

ExitStatus run_map(const MapOptions& options) {
  const certificates::Design design = certificates::read_design_file(options.design);
  if (!reports::has_map(design)) {
    refuse_tracker(options.design, design, "map", reports::trackers_with_map());
  }
  const bool by_name = options.directory.empty();
  const std::filesystem::path directory =
      by_name ? default_folder("maps-out", options.design) : std::filesystem::path(options.directory);
  const reports::MapResult result = [&] {
    const Interruption interruption;
    reports::MapRequest request = options.request;
    if (!options.over.empty()) {
      request.over = certificates::free_parameter(options.over).value();
    }
    request.deadline = (options.seconds > 0.0 ? search::Deadline(options.seconds) : search::Deadline())
                           .or_when(Interruption::flag());
    const ProgressLine line(options.quiet, "mapping");
    try {
      return reports::write_map(design, request, directory, std::cref(line));
    } catch (const certificates::RequestError& error) {
      const auto position = design.positions.find(error.key());
      throw certificates::InputError(
          options.design, position != design.positions.end() ? position->second : certificates::Position{},
          error.what());
    }
  }();
  if (!result.file) {
    fmt::print("{}: undecided: {}\n", options.design, result.sentence);
    return not_proved;
  }
  if (by_name) {
    mark_folder(directory, options.design);
  }
  fmt::print("{}: {}\n", result.file->string(), result.sentence);
  return all_proved;
}

ExitStatus run_show(const ShowOptions& options) {
  const certificates::Design design = certificates::read_design_file(options.design);
  const certificates::TrackerKind& kind = certificates::kind_of(design);
  if (kind.show == nullptr) {
    refuse_tracker(options.design, design, "show",
                   certificates::names_of_kinds([](const auto& each) { return each.show != nullptr; }));
  }
  certificates::CodeLanguage language = certificates::code_language(options.language).value();
  if (!options.precision.empty()) {
    if (language != certificates::CodeLanguage::c) {
      throw certificates::InputError(options.design, {}, "--precision without --language c; allowed: both");
    }
    language = options.precision == "single" ? certificates::CodeLanguage::single_precision_c
                                             : certificates::CodeLanguage::double_precision_c;
  }
  fmt::print("{}", kind.show(design, language));
  return all_proved;
}

ExitStatus run_tie(const TieOptions& options) {
  const certificates::Design design = certificates::read_design_file(options.design);
  const certificates::TrackerKind& kind = certificates::kind_of(design);
  if (kind.tie == nullptr) {
    refuse_tracker(options.design, design, "tie",
                   certificates::names_of_kinds([](const auto& each) { return each.tie != nullptr; }));
  }
  certificates::TieRequest request;
  request.builds = options.builds;
  request.emulator = options.emulator;
  request.states = options.states;
  request.seed = options.seed;
  for (const std::string& words : options.expressions) {
    const std::size_t sign = words.find('=');
    request.expressions[words.substr(0, sign)] = words.substr(sign + 1);
  }
  const certificates::TieAnswer answer = [&] {
    const ProgressLine line(options.quiet, "comparing");
    request.progress = [&](int done, int all) { line(done, all, "builds"); };
    return kind.tie(design, options.design, request);
  }();
  fmt::print("{}", answer.text);
  return answer.is_equal ? all_proved : not_proved;
}

}  // namespace veritrack::cli
