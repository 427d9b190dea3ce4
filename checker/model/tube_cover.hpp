// Statements over all phases and frequencies of tubes: cells of both are halved until the statement is
// certain of each.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "checker/model/tube_step.hpp"

namespace veritrack::checker {

/// What is found of a part of a tube: which of the questions are not certain of it, and whether it is better
/// to halve its frequencies than its phases.
struct PartAnswer {
  std::vector<std::size_t> open;
  bool halve_frequencies = false;
};
/// Asks some questions of a part. Called from several threads.
using PartQuestion = std::function<PartAnswer(const Tube& tube, const TubePart& part,
                                              const std::vector<std::size_t>& questions)>;
/// How many parts of a turn, and of the frequencies of the tube, to begin with: powers of two.
struct FirstGrid {
  std::size_t phases = 32;
  std::size_t frequencies = 1;
};

/// True only when the answer is certain on parts that cover all phases and frequencies of all tubes, for all
/// questions 0 to count(tube) - 1 of each tube. Gives up where the middle of a part fails. Adds the parts to
/// `cells`.
bool certain_everywhere(const std::vector<Tube>& tubes, const std::function<FirstGrid(const Tube&)>& grid,
                        const std::function<std::size_t(const Tube&)>& count, const PartQuestion& ask,
                        std::int64_t& cells);

}  // namespace veritrack::checker
