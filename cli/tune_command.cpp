// veritrack tune: design values for the best guarantee, and the certificate of the result.
#include <fmt/format.h>

#include <filesystem>
#include <functional>

#include "certificates/design/design_reader.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/design/request_error.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/document/output_files.hpp"
#include "certificates/document/tuning.hpp"
#include "certificates/tuning/certified_outcome.hpp"
#include "cli/commands.hpp"
#include "cli/default_folder.hpp"
#include "cli/interruption.hpp"
#include "cli/progress_line.hpp"
#include "reports/certificate_files.hpp"
#include "reports/tuning/tuning_files.hpp"

namespace veritrack::cli {

namespace {

namespace fs = std::filesystem;

certificates::Position position_of(const certificates::Design& design, const std::string& key) {
  const auto found = design.positions.find(key);
  return found != design.positions.end() ? found->second : certificates::Position{};
}

certificates::TuningResult tuned(const certificates::Design& design, const std::string& text,
                                 const TuneOptions& options) {
  const Interruption interruption;
  certificates::TuningRequest request;
  request.design_text = text;
  request.objective = options.objective;
  request.most_designs = options.designs;
  for (const std::string& words : options.over) {
    request.over.push_back(certificates::free_parameter(words).value());
  }
  request.free_leak = options.free_leak;
  request.with_trade_off = !options.no_certificate;
  request.deadline = (options.seconds > 0.0 ? search::Deadline(options.seconds) : search::Deadline())
                         .or_when(Interruption::flag());
  const ProgressLine line(options.quiet, "tuning");
  request.progress = [&](int done, int most) { line(done, most, "designs looked at"); };
  try {
    return certificates::tune(design, request);
  } catch (const certificates::RequestError& error) {
    throw certificates::InputError(options.design, position_of(design, error.key()), error.what());
  }
}

void print_sentences(const certificates::TuningResult& result) {
  for (const std::string& note : result.notes) {
    fmt::print("{}\n", note);
  }
  for (const std::string& change : result.changes) {
    fmt::print("{}\n", change);
  }
}

}  // namespace

ExitStatus run_tune(const TuneOptions& options) {
  const std::string text = certificates::read_design_text(options.design);
  const certificates::Design design = certificates::read_design(text, options.design);
  if (!certificates::can_be_tuned(design)) {
    throw certificates::InputError(
        options.design, position_of(design, "tracker"),
        fmt::format("veritrack tune cannot be used with the tracker {}; allowed: {}", design.tracker,
                    certificates::trackers_with_tuning()));
  }
  const fs::path output =
      options.output.empty() ? fs::path(options.design).stem().string() + "-tuned.toml" : options.output;
  certificates::TuningResult result = tuned(design, text, options);
  if (!result.design_text) {
    fmt::print("{}: undecided: {}\n", options.design, result.reason);
    return not_proved;
  }
  certificates::OutputFiles files;
  files.keep(options.design);
  files.stage(output, *result.design_text);
  files.commit();
  if (options.no_certificate) {
    print_sentences(result);
    fmt::print("{}: written, not certified\n", output.string());
    return all_proved;
  }
  const bool by_name = options.directory.empty();
  const fs::path directory =
      by_name ? default_folder("certificates-out", output) : fs::path(options.directory);
  // From the text, because the output need not be a file that can be read again.
  const certificates::Certificate certificate = [&] {
    const ProgressLine line(options.quiet, "certifying the result");
    return certificates::certify(certificates::read_design(*result.design_text, output.string()),
                                 output.filename().string(), *result.design_text, std::cref(line),
                                 certificates::Extent::everything);
  }();
  for (const std::string& sentence : certificates::certified_in_gaussian_noise(certificate)) {
    result.notes.push_back(sentence);
  }
  const reports::CertificateFiles written =
      reports::write_certificate_files(certificate, directory, options.design);
  std::string missing = written.missing_figures;
  if (result.trade_off) {
    missing = reports::write_tuning_files(result, output.filename().string(), directory);
  }
  if (by_name) {
    mark_folder(directory, output);
  }
  if (!missing.empty()) {
    fmt::print(stderr, "{}: written without its figures; {}\n", written.document.string(), missing);
  }
  print_sentences(result);
  fmt::print("{}: {}\n", output.string(), certificates::headline(certificate));
  fmt::print("{}\n", written.document.string());
  const bool fine = !certificate.verdict || *certificate.verdict == rigor::Verdict::proved;
  return fine ? all_proved : not_proved;
}

}  // namespace veritrack::cli
