// `veritrack new model --c`: a harness and a design for a file that holds a loop.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "certificates/design/design.hpp"

namespace veritrack::certificates::code {

struct NewCodeRequest {
  std::filesystem::path source;    ///< a file of C or C++
  std::string function;            ///< that takes a sample; empty: the likeliest
  std::vector<std::string> flags;  ///< of the compiler, as in [code]
  std::filesystem::path design;    ///< the file to be written
};

struct NewCode {
  std::filesystem::path harness;   ///< beside the design
  std::string harness_text;        ///< empty: the file is its own harness
  std::vector<std::string> files;  ///< of [code]
  std::vector<std::string> flags;
  std::string source;        ///< its name, without folders
  std::string step;          ///< the function that takes a sample, and its line
  int samples = 1;           ///< or 2
  double sample_rate = 0.0;  ///< Hz; 0: the program has no time
  bool is_guessed_rate = false;
  std::string guessed;  ///< names of numbers that the harness sets without a ground in the file
};

/// Finds the step in a file, and writes around it. Throws InputError, at a place of the file, when it does
/// not compile, or holds no such function.
[[nodiscard]] NewCode new_code(const NewCodeRequest& request);

/// The design file. `start` is the frequency in rad/sample at which the program starts; 0: not known.
[[nodiscard]] std::string new_code_design(const NewCode& code, double start);

/// The frequency at which the program of a design starts, rad/sample; 0: not known. Throws InputError when
/// the files do not compile.
[[nodiscard]] double start_frequency(const NewCode& code, const std::filesystem::path& design);

/// These functions, for those who reach them through the format of a tracker (DesignFormat): a build without
/// that tracker has none of them.
struct CodeWriter {
  NewCode (*find)(const NewCodeRequest& request);
  std::string (*design)(const NewCode& code, double start);
  double (*start)(const NewCode& code, const std::filesystem::path& design);
};
inline constexpr CodeWriter kCodeWriter{new_code, new_code_design, start_frequency};

}  // namespace veritrack::certificates::code
