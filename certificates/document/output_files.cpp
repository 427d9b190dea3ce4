#include "certificates/document/output_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "certificates/design/file_descriptor.hpp"
#include "certificates/design/input_error.hpp"

namespace veritrack::certificates {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTextLimit = 4096;

std::string reason_of(int error) {
  return std::generic_category().message(error);
}

[[noreturn]] void fail(const fs::path& path, int error) {
  throw OutputError(path, reason_of(error));
}

/// A new, empty, hidden file in the folder of `target`.
fs::path make_temporary(const fs::path& target, int& descriptor) {
  std::string name = (target.parent_path() / ("." + target.filename().string() + ".XXXXXX")).string();
  descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) {
    fail(target, errno);
  }
  return name;
}

/// The permissions that open(2) would have given; mkostemp gives 0600. The process's mask can only be read by
/// setting it, so this is no place for a second thread that makes files.
void give_usual_permissions(int descriptor, const fs::path& target) {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  constexpr mode_t kReadableAndWritable = 0666;
  if (::fchmod(descriptor, kReadableAndWritable & ~mask) != 0) {
    fail(target, errno);
  }
}

void write_all(const FileDescriptor& file, std::string_view content, const fs::path& target) {
  while (!content.empty()) {
    const ssize_t count = file.write(content.data(), content.size());
    if (count <= 0) {
      fail(target, count < 0 ? errno : EIO);
    }
    content.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// Makes a rename last through a power cut. Some file systems cannot; that is no reason to refuse the output.
void synchronise_folder(const fs::path& folder) {
  const FileDescriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.is_open()) {
    ::fsync(directory.get());
  }
}

fs::path folder_of(const fs::path& target) {
  const fs::path folder = target.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

}  // namespace

OutputError::OutputError(const fs::path& path, const std::string& reason)
    : std::runtime_error(
          printable(fmt::format("{}: cannot be written: {}", path.string(), reason), kTextLimit)),
      path_(path),
      reason_(reason) {}

OutputFiles::~OutputFiles() {
  undo();
}

void OutputFiles::make_folder(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::is_directory(status)) {
    return;
  }
  if (fs::exists(status)) {
    fail(folder, ENOTDIR);
  }
  if (status.type() != fs::file_type::not_found) {
    fail(folder, error.value());
  }
  if (const fs::path above = folder.parent_path(); !above.empty() && above != folder) {
    make_folder(above);
  }
  constexpr mode_t kEveryPermission = 0777;  // less what the process's mask takes away
  if (::mkdir(folder.c_str(), kEveryPermission) == 0) {
    made_folders_.push_back(folder);
  } else if (errno != EEXIST) {
    fail(folder, errno);
  }
}

void OutputFiles::stage(const fs::path& target, std::string_view content) {
  if (!target.has_filename()) {
    throw OutputError(target, "the name of a file is missing");
  }
  const auto has_this_target = [&](const StagedFile& file) { return file.target == target; };
  if (std::any_of(files_.begin(), files_.end(), has_this_target)) {
    throw OutputError(target, "two outputs have this name");
  }
  make_folder(folder_of(target));
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) {
    fail(target, EISDIR);
  }
  int descriptor = -1;
  const fs::path temporary = make_temporary(target, descriptor);
  FileDescriptor file(descriptor);
  files_.push_back({target, temporary, {}, false});
  try {
    give_usual_permissions(file.get(), target);
    write_all(file, content, target);
    if (::fsync(file.get()) != 0 || file.close() != 0) {
      fail(target, errno);
    }
  } catch (const OutputError&) {
    ::unlink(temporary.c_str());
    files_.pop_back();
    throw;
  }
}

void OutputFiles::put_in_place(StagedFile& file) {
  // A hard link keeps what stood at the target within reach, and the target never goes missing. Where the
  // file system has no hard links what stood there cannot be put back.
  const fs::path previous = file.temporary.string() + ".previous";
  if (::link(file.target.c_str(), previous.c_str()) == 0) {
    file.previous = previous;
  }
  if (::rename(file.temporary.c_str(), file.target.c_str()) != 0) {
    fail(file.target, errno);
  }
  file.in_place = true;
}

void OutputFiles::commit() {
  try {
    for (StagedFile& file : files_) {
      put_in_place(file);
    }
  } catch (const OutputError&) {
    undo();
    throw;
  }
  for (const StagedFile& file : files_) {
    if (!file.previous.empty()) {
      ::unlink(file.previous.c_str());
    }
    synchronise_folder(folder_of(file.target));
  }
  files_.clear();
  made_folders_.clear();
}

void OutputFiles::undo() noexcept {
  for (auto file = files_.rbegin(); file != files_.rend(); ++file) {
    if (!file->in_place) {
      ::unlink(file->temporary.c_str());
    } else if (file->previous.empty()) {
      ::unlink(file->target.c_str());
    }
    if (!file->previous.empty()) {
      // rename(2) of two links to one file does nothing at all, hence the unlink after it.
      if (file->in_place) {
        ::rename(file->previous.c_str(), file->target.c_str());
      }
      ::unlink(file->previous.c_str());
    }
  }
  files_.clear();
  for (auto folder = made_folders_.rbegin(); folder != made_folders_.rend(); ++folder) {
    ::rmdir(folder->c_str());  // fails, rightly, when somebody else has put something there
  }
  made_folders_.clear();
}

}  // namespace veritrack::certificates
