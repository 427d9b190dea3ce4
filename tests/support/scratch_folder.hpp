// A folder for one test, and a user with restricted permissions.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace veritrack::test {

/// An empty folder that is removed with its contents.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "veritrack-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("no scratch folder: " + name);
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ScratchFolder(ScratchFolder&&) = delete;
  ScratchFolder& operator=(ScratchFolder&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::filesystem::path& name) const {
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// During its lifetime file permissions apply to this process, also when the tests run as root. The user can
/// enter `folder` but change nothing in it.
class UnprivilegedUser {
 public:
  explicit UnprivilegedUser(const std::filesystem::path& folder) : previous_(::geteuid()) {
    constexpr mode_t kLookOnly = 0555;
    if (::chmod(folder.c_str(), kLookOnly) != 0 || (previous_ == 0 && ::seteuid(kNobody) != 0)) {
      throw std::runtime_error("cannot take privileges away");
    }
    folder_ = folder;
  }
  ~UnprivilegedUser() {
    constexpr mode_t kOwner = 0700;
    if ((previous_ == 0 && ::seteuid(previous_) != 0) || ::chmod(folder_.c_str(), kOwner) != 0) {
      std::abort();
    }
  }
  UnprivilegedUser(const UnprivilegedUser&) = delete;
  UnprivilegedUser& operator=(const UnprivilegedUser&) = delete;
  UnprivilegedUser(UnprivilegedUser&&) = delete;
  UnprivilegedUser& operator=(UnprivilegedUser&&) = delete;

 private:
  static constexpr uid_t kNobody = 65534;
  uid_t previous_;
  std::filesystem::path folder_;
};

}  // namespace veritrack::test
