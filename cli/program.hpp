// The frame around the work of each of our programs.
#pragma once

#include <string>

namespace veritrack::cli {

/// Runs `run` and returns its exit status, or that of an error, whose message goes to standard error. The
/// output to standard output arrives, or the status is not zero.
[[nodiscard]] int run_program(int argc, char** argv, int (*run)(int argc, char** argv));

/// Whether the self-test of the interval arithmetic passes. Prints why it does not.
[[nodiscard]] bool trusts_arithmetic();

/// A program in the folder of this one.
[[nodiscard]] std::string path_beside(const char* name);

}  // namespace veritrack::cli
