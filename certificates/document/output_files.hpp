// Files out: a set of files that appears whole or not at all.
#pragma once

#include <filesystem>
#include <list>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/design/file_descriptor.hpp"
#include "certificates/document/output_target.hpp"

namespace veritrack::certificates {

/// Files on their way: each is written completely beside its target, and only when all are on the disk do
/// they take their names, replacing what stood there. An object that is destroyed before commit() leaves
/// nothing behind, neither files nor the folders it made; what a killed process leaves, the next one that
/// stages the same target removes. A device or FIFO is written as it is, after all files have their names,
/// and of a link it is the target that is replaced.
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
  /// every byte reached the disk. A file may be staged once, and may be none that is to be kept. Throws
  /// OutputError; what was staged before stays staged.
  void stage(const std::filesystem::path& target, std::string_view content);

  /// Gives all staged files their names. Throws OutputError; a file that had taken its name by then is taken
  /// away again, or its predecessor put back. The object is empty afterwards and may be used anew.
  void commit();

 private:
  struct StagedFile {
    OutputTarget target;
    std::filesystem::path temporary;
    FileDescriptor lock;             // of the temporary file: held as long as this process is at work on it
    std::filesystem::path previous;  // what stood at the target, set aside; empty when nothing did
    FileDescriptor previous_lock;
    bool in_place = false;
  };
  struct StagedText {
    OutputTarget target;
    std::string text;
  };

  void make_folder(const std::filesystem::path& folder);
  void put_in_place(StagedFile& file);
  /// Back to how it was before the first stage().
  void undo() noexcept;

  std::vector<std::filesystem::path> kept_;
  std::list<StagedFile> files_;
  std::vector<StagedText> texts_;  // for what is written as it is
  std::vector<std::filesystem::path> made_folders_;
};

}  // namespace veritrack::certificates
