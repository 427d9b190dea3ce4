#include "cli/default_folder.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <system_error>

#include "certificates/document/output_files.hpp"

namespace veritrack::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = ".design";

/// The design file that the folder's contents are of; empty when nothing says so or it exists no more.
fs::path owner_of(const fs::path& folder) {
  std::ifstream file(folder / kMark);
  std::string line;
  if (!std::getline(file, line) || line.empty()) {
    return {};
  }
  std::error_code error;
  fs::path owner = fs::canonical(folder / line, error);
  return error ? fs::path() : owner;
}

}  // namespace

fs::path default_folder(const fs::path& parent, const fs::path& design) {
  fs::path folder = parent / design.stem();
  const fs::path owner = owner_of(folder);
  std::error_code error;
  if (!owner.empty() && !fs::equivalent(owner, design, error)) {
    throw certificates::OutputError(
        folder, fmt::format("it holds the results of {}; allowed: another folder, with --out",
                            fs::proximate(owner, error).string()));
  }
  return folder;
}

void mark_folder(const fs::path& folder, const fs::path& design) {
  std::error_code error;
  const fs::path path = fs::proximate(design, folder, error);
  certificates::OutputFiles files;
  files.stage(folder / kMark, path.string() + "\n");
  files.commit();
}

}  // namespace veritrack::cli
