#include "certificates/document/output_files.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "certificates/design/file_descriptor.hpp"
#include "certificates/document/abandoned_files.hpp"

namespace veritrack::certificates {

namespace {

namespace fs = std::filesystem;

std::string reason_of(int error) {
  return std::generic_category().message(error);
}

[[noreturn]] void fail(const fs::path& path, int error) {
  throw OutputError(path, reason_of(error));
}

/// A new, empty, hidden file in the folder of the target, locked: see remove_abandoned_files.
fs::path make_temporary(const OutputTarget& target, FileDescriptor& descriptor) {
  for (;;) {
    std::string name = temporary_name(target.file).string();
    descriptor.reset(::mkostemp(name.data(), O_CLOEXEC));
    if (!descriptor.is_open()) {
      fail(target.name, errno);
    }
    ::flock(descriptor.get(), LOCK_EX);  // a file system without locks is no reason to refuse the output
    struct stat status {};
    if (::fstat(descriptor.get(), &status) == 0 && status.st_nlink > 0) {
      return name;
    }
    // Another process took it for abandoned before it was locked: once more.
  }
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

void write_as_it_is(const OutputTarget& target, std::string_view content) {
  const FileDescriptor file(target.open_descriptor >= 0
                                ? ::fcntl(target.open_descriptor, F_DUPFD_CLOEXEC, 0)
                                : ::open(target.name.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
  if (!file.is_open()) {
    fail(target.name, errno);
  }
  write_all(file, content, target.name);
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
  constexpr mode_t kEveryPermission = 0777;  // minus those that the process's mask removes
  if (::mkdir(folder.c_str(), kEveryPermission) == 0) {
    made_folders_.push_back(folder);
  } else if (errno != EEXIST) {
    fail(folder, errno);
  }
}

void OutputFiles::keep(const fs::path& input) {
  kept_.push_back(input);
}

void OutputFiles::stage(const fs::path& name, std::string_view content) {
  const OutputTarget target = resolve_output(name);
  if (target.as_it_is) {
    texts_.push_back({target, std::string(content)});
    return;
  }
  const auto is_this = [&](const fs::path& input) { return is_file(target, input); };
  if (std::any_of(kept_.begin(), kept_.end(), is_this)) {
    throw OutputError(name, "it is an input of this command");
  }
  const auto has_this_target = [&](const StagedFile& file) { return same_target(file.target, target); };
  if (std::any_of(files_.begin(), files_.end(), has_this_target)) {
    throw OutputError(name, "two outputs have this name");
  }
  make_folder(folder_of(target.file));
  remove_abandoned_files(target.file);
  StagedFile& file = files_.emplace_back();
  try {
    file.target = target;
    file.temporary = make_temporary(target, file.lock);
    give_usual_permissions(file.lock.get(), name);
    write_all(file.lock, content, name);
    if (::fsync(file.lock.get()) != 0) {
      fail(name, errno);
    }
  } catch (const OutputError&) {
    if (!file.temporary.empty()) {
      ::unlink(file.temporary.c_str());
    }
    files_.pop_back();
    throw;
  }
}

void OutputFiles::put_in_place(StagedFile& file) {
  // A hard link keeps the previous file at the target within reach, and the target never goes missing. Where
  // the file system has no hard links the previous file cannot be put back.
  const fs::path previous = name_of_previous(file.temporary);
  file.previous_lock.reset(::open(file.target.file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.previous_lock.is_open()) {
    ::flock(file.previous_lock.get(), LOCK_SH | LOCK_NB);
  }
  if (::link(file.target.file.c_str(), previous.c_str()) == 0) {
    file.previous = previous;
  }
  if (::rename(file.temporary.c_str(), file.target.file.c_str()) != 0) {
    fail(file.target.name, errno);
  }
  file.in_place = true;
}

void OutputFiles::commit() {
  try {
    for (StagedFile& file : files_) {
      put_in_place(file);
    }
    // Last, because output to a device or a FIFO cannot be taken back.
    for (const StagedText& text : texts_) {
      write_as_it_is(text.target, text.text);
    }
  } catch (const OutputError&) {
    undo();
    throw;
  }
  for (const StagedFile& file : files_) {
    if (!file.previous.empty()) {
      ::unlink(file.previous.c_str());
    }
    synchronise_folder(folder_of(file.target.file));
  }
  files_.clear();
  texts_.clear();
  made_folders_.clear();
}

void OutputFiles::undo() noexcept {
  for (auto file = files_.rbegin(); file != files_.rend(); ++file) {
    if (!file->in_place) {
      ::unlink(file->temporary.c_str());
    } else if (file->previous.empty()) {
      ::unlink(file->target.file.c_str());
    }
    if (!file->previous.empty()) {
      // rename(2) of two links to one file does nothing at all, hence the unlink after it.
      if (file->in_place) {
        ::rename(file->previous.c_str(), file->target.file.c_str());
      }
      ::unlink(file->previous.c_str());
    }
  }
  files_.clear();
  texts_.clear();
  for (auto folder = made_folders_.rbegin(); folder != made_folders_.rend(); ++folder) {
    ::rmdir(folder->c_str());  // fails, rightly, when somebody else has put something there
  }
  made_folders_.clear();
}

}  // namespace veritrack::certificates
