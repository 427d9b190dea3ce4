// Statements over all phases and frequencies of tubes: cells of both are halved until the statement is
// certain of each.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "checker/model/tube_step.hpp"

namespace veritrack::checker {

/// The finding on a part of a tube: which of the questions are not certain on it, and whether it is better to
/// halve its frequencies than its phases.
struct PartAnswer {
  std::vector<std::size_t> open;
  std::optional<bool> halve_frequencies;  ///< nothing: not known
};
/// Asks some questions of a part of a tube, or of something else with this number. Called from several
/// threads.
using PartQuestion = std::function<PartAnswer(std::size_t number, const TubePart& part,
                                              const std::vector<std::size_t>& questions)>;
/// The initial number of parts of a turn, and of the frequencies of the tube, powers of two; and the number
/// of questions.
struct FirstGrid {
  std::size_t phases = 32;
  std::size_t frequencies = 1;
  std::size_t questions = 1;
};

/// True only when the answer is certain on parts that cover all phases and frequencies of all tubes, number
/// 0, 1, ..., and there are tubes and questions. Gives up where the middle of a part fails. Adds the parts to
/// `cells`.
bool certain_everywhere(const std::vector<FirstGrid>& tubes, const PartQuestion& ask, std::int64_t& cells);

}  // namespace veritrack::checker
