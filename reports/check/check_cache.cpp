#include "reports/check/check_cache.hpp"

#include <fcntl.h>
#include <mpfr.h>
#include <sys/stat.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <utility>

#include "certificates/design/file_descriptor.hpp"
#include "certificates/document/output_files.hpp"
#include "certificates/document/sha256.hpp"

namespace veritrack::reports {

namespace {

/// The text of a file that belongs to this user, and that nobody else can write to.
std::optional<std::string> own_text(const std::filesystem::path& path) {
  const certificates::FileDescriptor file(
      ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat status {};
  constexpr mode_t kWritableByOthers = 022;
  constexpr off_t kLargest = off_t{1} << 20;
  if (!file.is_open() || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
      status.st_uid != ::geteuid() || (status.st_mode & kWritableByOthers) != 0 ||
      status.st_size > kLargest) {
    return std::nullopt;
  }
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t length = 0;
  while (length < text.size()) {
    const ssize_t count = file.read(text.data() + length, text.size() - length);
    if (count <= 0) {
      return std::nullopt;
    }
    length += static_cast<std::size_t>(count);
  }
  return text;
}

/// The first line, which says of what the rest is.
std::string heading(const std::string& key) {
  return "veritrack/check-cache/1 " + key + "\n";
}

}  // namespace

CheckCache::CheckCache(std::filesystem::path folder, std::string program)
    : folder_(std::move(folder)), program_(std::move(program)) {}

std::filesystem::path CheckCache::file_of(const std::string& design_text) const {
  return folder_ / certificates::sha256(program_ + "\n" + design_text);
}

std::optional<CheckedDesign> CheckCache::find(const std::string& design_text) const {
  const std::filesystem::path file = file_of(design_text);
  const std::optional<std::string> text = own_text(file);
  const std::string expected = heading(file.filename().string());
  if (!text || !text->starts_with(expected)) {
    return std::nullopt;
  }
  std::optional<CheckedDesign> found = checked_from_text(text->substr(expected.size()));
  return found && is_final(*found) ? found : std::nullopt;
}

void CheckCache::keep(const std::string& design_text, const CheckedDesign& design) const {
  if (!is_final(design)) {
    return;
  }
  const std::filesystem::path file = file_of(design_text);
  try {
    certificates::OutputFiles files;
    files.stage(file, heading(file.filename().string()) + to_text(design) + "\n");
    files.commit();
    std::filesystem::permissions(file,
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  } catch (const std::exception&) {
    return;  // it is checked again the next time
  }
}

std::filesystem::path default_cache_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && std::filesystem::path(cache).is_absolute()) {
    return std::filesystem::path(cache) / "veritrack" / "check";
  }
  const char* home = std::getenv("HOME");
  if (home != nullptr && std::filesystem::path(home).is_absolute()) {
    return std::filesystem::path(home) / ".cache" / "veritrack" / "check";
  }
  return {};
}

std::string program_identity(const std::filesystem::path& file) {
  std::ifstream program(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(program), std::istreambuf_iterator<char>()};
  if (!program || bytes.empty()) {
    return {};
  }
  // The library that rounds is not in the file.
  return certificates::sha256(bytes) + " " + VERITRACK_VERSION + " MPFR " + mpfr_get_version();
}

}  // namespace veritrack::reports
