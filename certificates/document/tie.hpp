// What `veritrack tie` asks of a tracker that is given as code, and its answer.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace veritrack::certificates {

struct TieRequest {
  std::vector<std::string> builds;                 ///< commands, split at spaces
  std::string emulator;                            ///< empty: programs run by themselves
  int states = 4000;                               ///< to draw
  std::uint64_t seed = 1;                          ///< of what is drawn
  std::map<std::string, std::string> expressions;  ///< of C, by the name of the state that they reach
  std::function<void(int, int)> progress;          ///< builds done, and all; may be empty
};

struct TieAnswer {
  bool is_equal = false;
  std::string text;  ///< lines, the answer first
};

}  // namespace veritrack::certificates
