// veritrack diff: what became better or worse from one certificate, or design, to another.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>

#include "analysis/rigor/decimal.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/json.hpp"
#include "cli/commands.hpp"
#include "cli/progress_line.hpp"
#include "reports/comparison/certificate_changes.hpp"

namespace veritrack::cli {

namespace {

namespace fs = std::filesystem;
using ChangeKind = reports::CertificateChange::Kind;

/// certificate.json: that of a folder, of a file, or of a design, which is certified.
std::string certificate_of(const std::string& path, bool quiet) {
  if (fs::path(path).extension() == ".toml") {
    const ProgressLine line(quiet, "certifying");
    return certificates::to_json(certificates::certify_file(path, std::cref(line)));
  }
  const fs::path file = fs::is_directory(path) ? fs::path(path) / "certificate.json" : fs::path(path);
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  try {
    reports::require_certificate(text);
  } catch (const std::invalid_argument& error) {
    throw certificates::InputError(
        file.string(), {},
        fmt::format("{}; allowed: a design file (*.toml), a certificate.json or its folder",
                    stream ? error.what() : "cannot be read"));
  }
  return text;
}

}  // namespace

ExitStatus run_diff(const DiffOptions& options) {
  const std::string before = certificate_of(options.before, options.quiet);
  const std::string after = certificate_of(options.after, options.quiet);
  const auto changes = reports::certificate_changes(before, after, rigor::nearest_double(options.tolerance));
  int better = 0;
  int worse = 0;
  for (const auto& [kind, text] : changes) {
    better += kind == ChangeKind::better ? 1 : 0;
    worse += kind == ChangeKind::worse ? 1 : 0;
    fmt::print("{:<8}{}\n",
               kind == ChangeKind::better  ? "better"
               : kind == ChangeKind::worse ? "worse"
                                           : "changed",
               text);
  }
  fmt::print("{} better, {} worse\n", better, worse);
  return worse > 0 ? not_proved : all_proved;
}

}  // namespace veritrack::cli
