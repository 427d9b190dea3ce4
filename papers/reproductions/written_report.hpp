// A research report, written.
#pragma once

#include <filesystem>
#include <string>

namespace veritrack::reports {

struct WrittenReport {
  std::filesystem::path document;
  std::string warning;  ///< what its runs are too few for; empty when they are enough
};

}  // namespace veritrack::reports
