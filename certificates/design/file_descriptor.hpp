// An open file that closes itself, and can report whether closing succeeded.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <utility>

namespace veritrack::certificates {

/// Owns a POSIX file descriptor; negative when there is none.
class FileDescriptor {
 public:
  FileDescriptor() noexcept = default;
  explicit FileDescriptor(int descriptor) noexcept : descriptor_(descriptor) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  FileDescriptor(FileDescriptor&&) = delete;
  FileDescriptor& operator=(FileDescriptor&&) = delete;

  [[nodiscard]] bool is_open() const noexcept { return descriptor_ >= 0; }
  [[nodiscard]] int get() const noexcept { return descriptor_; }

  /// Closes what is open and owns `descriptor` from now on.
  void reset(int descriptor) noexcept {
    close();
    descriptor_ = descriptor;
  }

  /// As read(2) and write(2), restarted when a signal interrupts.
  [[nodiscard]] ssize_t read(char* buffer, std::size_t size) const noexcept {
    ssize_t count = -1;
    do {
      count = ::read(descriptor_, buffer, size);
    } while (count < 0 && errno == EINTR);
    return count;
  }
  [[nodiscard]] ssize_t write(const char* buffer, std::size_t size) const noexcept {
    ssize_t count = -1;
    do {
      count = ::write(descriptor_, buffer, size);
    } while (count < 0 && errno == EINTR);
    return count;
  }
  /// 0, or -1 with errno set: some file systems report a lost write only here. The descriptor is gone either
  /// way.
  int close() noexcept {
    const int descriptor = std::exchange(descriptor_, -1);
    return descriptor >= 0 ? ::close(descriptor) : 0;
  }

 private:
  int descriptor_ = -1;
};

}  // namespace veritrack::certificates
