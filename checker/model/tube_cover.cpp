#include "checker/model/tube_cover.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "checker/numbers/threads.hpp"

namespace veritrack::checker {

namespace {

constexpr int kMostHalvings = 40;
/// The middle of a part is asked each time it has been halved this many times.
constexpr int kBetweenMiddles = 3;
/// After this many halvings in one direction the other one is halved, whatever the answers suggest: they are
/// guesses.
constexpr int kMostAlike = 6;

/// A part that is not certain yet.
struct OpenPart {
  TubePart part;
  std::vector<std::size_t> questions;
  int halvings = 0;
  bool was_by_frequency = false;  ///< the last ones, `alike` of them
  int alike = 0;
};

/// The last part for which the answer to some questions was certain. Its neighbours need parts of about the
/// same size, so that parts a little larger are halved before they are asked. Much larger ones are asked: a
/// statement that is hard at one place need not be hard everywhere.
struct LastCertain {
  std::vector<std::size_t> questions;
  TubePart part;

  /// Whether to halve by frequency, or by phase, for these questions; empty where a part is not larger.
  [[nodiscard]] std::optional<bool> halving_of(const OpenPart& here) const {
    constexpr double kMuch = 4.0;
    const double ratio = (here.part.half_turn / part.half_turn) * (here.part.half_z / part.half_z);
    if (questions.empty() || questions != here.questions || !(ratio <= kMuch)) {
      return std::nullopt;
    }
    return here.part.half_turn > part.half_turn ? std::optional(false)
           : here.part.half_z > part.half_z     ? std::optional(true)
                                                : std::nullopt;
  }
};

void halve(const OpenPart& here, const std::vector<std::size_t>& questions, bool by_frequency,
           std::vector<OpenPart>& open) {
  const int alike = here.alike > 0 && by_frequency == here.was_by_frequency ? here.alike + 1 : 1;
  for (const bool second : {true, false}) {
    open.push_back({by_frequency ? here.part.half_of_frequencies(second) : here.part.half_of_phases(second),
                    questions, here.halvings + 1, by_frequency, alike});
  }
}

bool is_certain(std::size_t tube, const TubePart& first, std::size_t count, const PartQuestion& ask,
                std::int64_t& cells) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<OpenPart> open;
  open.push_back({first, std::move(all)});
  LastCertain last;
  while (!open.empty()) {
    const OpenPart here = std::move(open.back());
    open.pop_back();
    if (const auto halving = last.halving_of(here); halving && here.halvings < kMostHalvings) {
      halve(here, here.questions, *halving, open);
      continue;
    }
    ++cells;
    PartAnswer answer = ask(tube, here.part, here.questions);
    if (answer.open.empty()) {
      last = {here.questions, here.part};
      continue;
    }
    const bool is_time = here.halvings % kBetweenMiddles == kBetweenMiddles - 1;
    if (here.halvings == kMostHalvings ||
        (is_time && !ask(tube, here.part.middle(), answer.open).open.empty())) {
      return false;
    }
    // Where the better direction is unknown, both take turns.
    const bool by_frequency = here.alike == kMostAlike
                                  ? !here.was_by_frequency
                                  : answer.halve_frequencies.value_or(here.halvings % 2 == 0);
    halve(here, answer.open, by_frequency, open);
  }
  return true;
}

}  // namespace

bool certain_everywhere(const std::vector<FirstGrid>& tubes, const PartQuestion& ask, std::int64_t& cells) {
  // Only the number of parts is kept: a certificate chooses it.
  std::vector<std::size_t> ends;
  std::size_t count = 0;
  bool all_are_asked = !tubes.empty();
  for (const FirstGrid& parts : tubes) {
    all_are_asked = all_are_asked && parts.phases > 0 && parts.frequencies > 0 && parts.questions > 0;
    count += parts.phases * parts.frequencies;
    ends.push_back(count);
  }
  std::atomic<std::int64_t> all_cells = 0;
  const std::size_t failed = first_failure(count, [&](std::size_t k) {
    spend();
    const auto tube = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), k) - ends.begin());
    const FirstGrid& parts = tubes[tube];
    const std::size_t place = k - (ends[tube] - parts.phases * parts.frequencies);
    const TubePart part =
        TubePart::of_grid(place % parts.phases, parts.phases, place / parts.phases, parts.frequencies);
    std::int64_t of_part = 0;
    const bool certain = is_certain(tube, part, parts.questions, ask, of_part);
    all_cells += of_part;
    return certain;
  });
  cells += all_cells;
  return all_are_asked && failed == count;
}

}  // namespace veritrack::checker
