#include "certificates/document/abandoned_files.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

#include "certificates/design/file_descriptor.hpp"

namespace veritrack::certificates {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRandom = "XXXXXX";  // replaced by mkostemp
constexpr std::string_view kPrevious = ".previous";

std::string hidden_prefix(const fs::path& target) {
  return "." + target.filename().string() + ".";
}

bool is_letter_or_digit(char letter) {
  return (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
         (letter >= 'A' && letter <= 'Z');
}

/// A name that make_temporary could have given to a file beside that target, or the one beside it.
bool is_ours(std::string_view name, std::string_view prefix) {
  if (name.substr(0, prefix.size()) != prefix) {
    return false;
  }
  name.remove_prefix(prefix.size());
  const std::string_view random = name.substr(0, kRandom.size());
  const std::string_view rest = name.substr(random.size());
  return random.size() == kRandom.size() && std::all_of(random.begin(), random.end(), is_letter_or_digit) &&
         (rest.empty() || rest == kPrevious);
}

void remove_unless_locked(const fs::path& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat status {};
  if (file.is_open() && ::fstat(file.get(), &status) == 0 && S_ISREG(status.st_mode) &&
      ::flock(file.get(), LOCK_EX | LOCK_NB) == 0) {
    ::unlink(path.c_str());
  }
}

}  // namespace

fs::path temporary_name(const fs::path& target) {
  return target.parent_path() / (hidden_prefix(target) + std::string(kRandom));
}

fs::path name_of_previous(const fs::path& temporary) {
  return temporary.string() + std::string(kPrevious);
}

void remove_abandoned_files(const fs::path& target) {
  const std::string prefix = hidden_prefix(target);
  const fs::path folder = target.parent_path();
  std::error_code error;
  fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (is_ours(entry->path().filename().string(), prefix)) {
      remove_unless_locked(entry->path());
    }
  }
}

}  // namespace veritrack::certificates
