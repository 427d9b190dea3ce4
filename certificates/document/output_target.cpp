#include "certificates/document/output_target.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>

#include "certificates/design/input_error.hpp"

namespace veritrack::certificates {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTextLimit = 4096;
constexpr int kLinkLimit = 40;  // as the kernel's

using Status = struct stat;

[[noreturn]] void fail_with(const fs::path& name, int error) {
  throw OutputError(name, std::generic_category().message(error));
}

bool same_inode(const Status& a, const Status& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/// Standard output or error when they already write to that; otherwise negative.
int descriptor_of(const Status& status) {
  for (const int standard : std::array{STDOUT_FILENO, STDERR_FILENO}) {
    Status open{};
    if (::fstat(standard, &open) == 0 && same_inode(open, status)) {
      return standard;
    }
  }
  return -1;
}

/// The end of a chain of links, whether something is there or not.
fs::path end_of_links(const fs::path& name) {
  fs::path path = name;
  for (int followed = 0; followed < kLinkLimit; ++followed) {
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(path, error))) {
      return path;
    }
    const fs::path next = fs::read_symlink(path, error);
    if (error) {
      fail_with(name, error.value());
    }
    path = path.parent_path() / next;  // an absolute path replaces what it is appended to
  }
  fail_with(name, ELOOP);
}

fs::path normal(const fs::path& path) {
  std::error_code error;
  fs::path result = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path : result;
}

}  // namespace

OutputError::OutputError(const fs::path& path, const std::string& reason)
    : std::runtime_error(
          printable(fmt::format("{}: cannot be written: {}", path.string(), reason), kTextLimit)),
      path_(path),
      reason_(reason) {}

OutputTarget resolve_output(const fs::path& name) {
  if (!name.has_filename()) {
    throw OutputError(name, "the name of a file is missing");
  }
  OutputTarget target{name, name, false, -1};
  Status status{};
  if (::stat(name.c_str(), &status) != 0) {
    target.file = end_of_links(name);  // nothing there yet; other faults show when the file is made
    return target;
  }
  if (S_ISDIR(status.st_mode)) {
    fail_with(name, EISDIR);
  }
  target.open_descriptor = descriptor_of(status);
  target.as_it_is = !S_ISREG(status.st_mode) || target.open_descriptor >= 0;
  if (!target.as_it_is) {
    target.file = end_of_links(name);
  }
  return target;
}

bool same_target(const OutputTarget& a, const OutputTarget& b) {
  return normal(a.file) == normal(b.file);
}

bool is_file(const OutputTarget& output, const fs::path& file) {
  Status first{};
  Status second{};
  return ::stat(output.file.c_str(), &first) == 0 && ::stat(file.c_str(), &second) == 0 &&
         same_inode(first, second);
}

}  // namespace veritrack::certificates
