// Writing files: a set of files that appears whole or not at all.
#pragma once

#include <filesystem>
#include <list>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/design/file_descriptor.hpp"
#include "certificates/document/output_target.hpp"

namespace veritrack::certificates {

/// Staged files: each is written completely beside its target, and only when all are on the disk do they take
/// their names, replacing the previous files. An object that is destroyed before commit() leaves nothing
/// behind, neither files nor the folders it made; files that a killed process leaves are removed by the next
/// one that stages the same target. A device or FIFO is written as it is, after all files have their names,
/// and for a link the target is replaced.
class OutputFiles {
 public:
  OutputFiles() = default;
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  OutputFiles(OutputFiles&&) = delete;
  OutputFiles& operator=(OutputFiles&&) = delete;

  /// From now on no output may be this file, under whatever name.
  void keep(const std::filesystem::path& input);

  /// Writes `content` to a new file beside `target`, whose folder is made when it is missing, and checks that
  /// every byte reached the disk. A file may be staged once, and must not be one that is to be kept. Throws
  /// OutputError; files staged before stay staged.
  void stage(const std::filesystem::path& target, std::string_view content);

  /// Gives all staged files their names. Throws OutputError; a file that had taken its name by then is
  /// removed again, or its predecessor put back. The object is empty afterwards and may be used again.
  void commit();

 private:
  struct StagedFile {
    OutputTarget target;
    std::filesystem::path temporary;
    FileDescriptor lock;             // of the temporary file: held as long as this process works on it
    std::filesystem::path previous;  // the previous file at the target, set aside; empty when there was none
    FileDescriptor previous_lock;
    bool in_place = false;
  };
  struct StagedText {
    OutputTarget target;
    std::string text;
  };

  void make_folder(const std::filesystem::path& folder);
  void put_in_place(StagedFile& file);
  /// Restores the state before the first stage().
  void undo() noexcept;

  std::vector<std::filesystem::path> kept_;
  std::list<StagedFile> files_;
  std::vector<StagedText> texts_;  // for targets that are written as they are
  std::vector<std::filesystem::path> made_folders_;
};

}  // namespace veritrack::certificates
