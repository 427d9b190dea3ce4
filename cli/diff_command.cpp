// veritrack diff: what became better or worse from one certificate, or design, to another.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

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

std::string_view word_of(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::better:
      return "better";
    case ChangeKind::worse:
      return "worse";
    case ChangeKind::accepted:
      return "accepted";
    case ChangeKind::easier:
      return "easier";
    case ChangeKind::other:
      break;
  }
  return "changed";
}

}  // namespace

ExitStatus run_diff(const DiffOptions& options) {
  const std::string before = certificate_of(options.before, options.quiet);
  const std::string after = certificate_of(options.after, options.quiet);
  const auto changes = [&] {
    try {
      return reports::certificate_changes(before, after, rigor::nearest_double(options.tolerance),
                                          options.accepted);
    } catch (const reports::NothingToAccept& error) {
      throw certificates::InputError("--accept", {}, error.what());
    }
  }();
  for (const auto& change : changes.list) {
    fmt::print("{:<9}{}\n", word_of(change.kind), change.text);
  }
  const int easier = changes.count(ChangeKind::easier);
  if (easier > 0) {
    fmt::print("{} better for an easier question, which do not count: {}\n",
               easier == 1 ? "1 result is" : fmt::format("{} results are", easier),
               fmt::join(changes.loosened, ", "));
  }
  const int worse = changes.count(ChangeKind::worse);
  const int accepted = changes.count(ChangeKind::accepted);
  fmt::print("{} better, {} worse{}\n", changes.count(ChangeKind::better), worse,
             accepted > 0 ? fmt::format(", {} accepted", accepted) : "");
  return worse > 0 ? not_proved : all_proved;
}

}  // namespace veritrack::cli
