// Files out: a set of files that appears whole or not at all.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace veritrack::certificates {

/// Thrown when an output cannot be written. what() is one line, `path: cannot be written: reason`.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::filesystem::path& path, const std::string& reason);
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }

 private:
  std::filesystem::path path_;
  std::string reason_;
};

/// Files on their way: each is written completely beside its target, and only when all are on the disk do
/// they take their names, replacing what stood there. An object that is destroyed before commit() leaves
/// nothing behind, neither files nor the folders it made.
class OutputFiles {
 public:
  OutputFiles() = default;
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  OutputFiles(OutputFiles&&) = delete;
  OutputFiles& operator=(OutputFiles&&) = delete;

  /// Writes `content` to a new file beside `target`, whose folder is made when it is missing, and checks that
  /// every byte reached the disk. A target may be staged once. Throws OutputError; what was staged before
  /// stays staged.
  void stage(const std::filesystem::path& target, std::string_view content);

  /// Gives all staged files their names. Throws OutputError; a file that had taken its name by then is taken
  /// away again, or its predecessor put back. The object is empty afterwards and may be used anew.
  void commit();

 private:
  struct StagedFile {
    std::filesystem::path target;
    std::filesystem::path temporary;
    std::filesystem::path previous;  // what stood at the target, set aside; empty when nothing did
    bool in_place = false;
  };

  void make_folder(const std::filesystem::path& folder);
  void put_in_place(StagedFile& file);
  /// Back to how it was before the first stage().
  void undo() noexcept;

  std::vector<StagedFile> files_;
  std::vector<std::filesystem::path> made_folders_;
};

}  // namespace veritrack::certificates
