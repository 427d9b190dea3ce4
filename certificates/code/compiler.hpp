// clang, run over a file of the user's: flags, limits, and its errors as ours.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "certificates/design/design.hpp"
#include "certificates/document/program.hpp"

namespace veritrack::certificates::code {

inline constexpr const char* kCompiler = "clang-14";

/// True for the name of a file of C++; others are C.
[[nodiscard]] bool is_cpp(const std::filesystem::path& path);

/// Throws InputError, at the place in `design_file`, for a flag that does not only say what is compiled.
void require_flags(const std::vector<SourceText>& flags, const std::filesystem::path& design_file);

/// The flags as clang knows them; relative folders are those from `folder`.
[[nodiscard]] std::vector<std::string> flag_arguments(const std::vector<SourceText>& flags,
                                                      const std::filesystem::path& folder);

/// Runs a program for at most 30 s of processor time. Throws InputError, at the place in `design_file`, when
/// it cannot be run or a signal ended it.
[[nodiscard]] ProgramRun run_limited(const std::string& program, const std::vector<std::string>& arguments,
                                     const std::filesystem::path& design_file, Position position,
                                     const std::vector<const MemoryFile*>& handed_over = {});

/// Throws the first error of a compiler, "file:line:column: error: what", as an InputError; of `file` where
/// it names none.
[[noreturn]] void refuse_compilation(const std::string& errors, const std::filesystem::path& file);

}  // namespace veritrack::certificates::code
