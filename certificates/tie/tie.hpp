// veritrack tie: whether the program that the user builds computes what the listing of [code] says.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "certificates/design/design.hpp"
#include "certificates/tie/comparison.hpp"
#include "certificates/tie/drawn_steps.hpp"

namespace veritrack::certificates::tie {

struct TieRequest {
  std::vector<std::string> builds;                 ///< commands, split at spaces
  std::string emulator;                            ///< empty: programs run by themselves
  int states = 4000;                               ///< to draw
  std::uint64_t seed = 1;                          ///< of what is drawn
  std::map<std::string, std::string> expressions;  ///< of C, by the name of the state that they reach
  std::function<void(int, int)> progress;          ///< builds done, and all; may be empty
};

struct TieResult {
  DrawnSteps drawn;
  std::vector<BuildResult> builds;

  [[nodiscard]] bool is_equal() const;
};

/// Nothing could be compared.
class NothingCompared : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The listing of a design with [code].
[[nodiscard]] const trackers::code::Listing& listing_of(const Design& design);

/// Whether a design has [code].
[[nodiscard]] bool has_code(const Design& design);

/// Builds the design's files by each command, runs the programs, and compares. This executes the user's code.
/// Throws BuildError, NothingCompared.
[[nodiscard]] TieResult tied(const Design& design, const std::filesystem::path& design_file,
                             const TieRequest& request);

/// The result in words, the answer first.
[[nodiscard]] std::string tie_text(const Design& design, const TieRequest& request, const TieResult& result);

}  // namespace veritrack::certificates::tie
