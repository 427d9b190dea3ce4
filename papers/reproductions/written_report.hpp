// A research report, written.
#pragma once

#include <filesystem>
#include <string>

namespace veritrack::reports {

struct WrittenReport {
  std::filesystem::path document;
  std::string warning;  ///< the questions for which its runs are too few; empty when there are none
};

}  // namespace veritrack::reports
