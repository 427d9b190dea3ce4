#include "cli/program.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <system_error>

#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/self_test.hpp"
#include "cli/commands.hpp"
#include "cli/standard_output.hpp"

namespace veritrack::cli {

namespace {

/// Freed memory is kept for the next polynomial instead of being given back to the kernel: with nine states
/// that took a third of the time.
void keep_freed_memory() {
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_MMAP_THRESHOLD, 1 << 25);
}

}  // namespace

int run_program(int argc, char** argv, int (*run)(int argc, char** argv)) {
  try {
    keep_freed_memory();
    prepare_standard_streams();
    const int status = run(argc, argv);
    finish_standard_output();
    return status;
  } catch (const rigor::RoundingModeError& error) {
    fmt::print(stderr, "veritrack: {}; nothing that was computed can be trusted\n", error.what());
    return bad_arithmetic;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  }
}

bool trusts_arithmetic() {
  const rigor::SelfTestReport self_test = rigor::run_self_test();
  if (self_test.passed()) {
    return true;
  }
  for (const std::string& failure : self_test.failures) {
    fmt::print(stderr, "veritrack: arithmetic self-test: {}\n", failure);
  }
  fmt::print(
      stderr,
      "veritrack: this machine or this build cannot be trusted with a certificate; nothing was computed\n");
  return false;
}

std::string path_beside(const char* name) {
  std::error_code error;
  return (std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / name).string();
}

}  // namespace veritrack::cli
