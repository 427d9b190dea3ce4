// veritrack tie: whether the program that the user builds computes what the listing of [code] says.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "certificates/design/design.hpp"
#include "certificates/document/tie.hpp"
#include "certificates/model/tie/comparison.hpp"
#include "certificates/model/tie/drawn_steps.hpp"

namespace veritrack::certificates::tie {

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

/// Builds the design's files by each command, runs the programs, and compares. This executes the user's code.
/// Throws BuildError, NothingCompared.
[[nodiscard]] TieResult tied(const Design& design, const std::filesystem::path& design_file,
                             const TieRequest& request);

/// `tie` of the record of the tracker (certificates/document/tracker_kind.hpp): tied(), in words. Throws
/// InputError for a design without [code].
[[nodiscard]] TieAnswer tie_model(const Design& design, const std::filesystem::path& design_file,
                                  const TieRequest& request);

/// The result in words, the answer first.
[[nodiscard]] std::string tie_text(const Design& design, const TieRequest& request, const TieResult& result);

}  // namespace veritrack::certificates::tie
