#include "checker/model/tube_evidence.hpp"

#include <algorithm>

#include "checker/model/series_evidence.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostParts = 1U << 16U;
constexpr std::size_t kMostLevels = 1024;

std::size_t power_of_two_from(const Tree& number, Objections& objections) {
  const long value = number.integer();
  const auto size = static_cast<std::size_t>(std::clamp<long>(value, 1, static_cast<long>(kMostParts)));
  if (static_cast<long>(size) != value || (size & (size - 1)) != 0) {
    objections.emplace_back("a first grid has a power of two parts, and not too many");
  }
  return size;
}

bool is_falling(const std::vector<double>& levels) {
  for (std::size_t j = 0; j + 1 < levels.size(); ++j) {
    if (!certainly_less(Ball(levels[j + 1]), Ball(levels[j]))) {
      return false;
    }
  }
  return !levels.empty() && certainly_positive(Ball(levels.back()));
}

/// In (0, 1], and below 1 when there are levels to come down.
bool is_shrinking(const PhaseTube& tube) {
  const bool has_one_level = tube.levels.size() <= 1;
  return tube.shrinking.size() == pairs_of(tube) &&
         std::all_of(tube.shrinking.begin(), tube.shrinking.end(), [&](double rate) {
           return certainly_positive(Ball(rate)) &&
                  (has_one_level ? certainly_at_most(Ball(rate), one) : certainly_less(Ball(rate), one));
         });
}

/// `shrinks`: rates are given.
PhaseTube tube_from(const Tree& cell, std::size_t all_states, std::size_t estimated, bool shrinks,
                    Objections& objections) {
  PhaseTube tube;
  tube.frequency = double_from(cell.at("frequency"));
  tube.half_width = double_from(cell.at("half_width"));
  tube.levels = doubles_from(cell.at("levels"));
  if (tube.levels.size() > kMostLevels) {
    throw Malformed("a tube of too many levels");
  }
  if (shrinks) {
    tube.shrinking = doubles_from(cell.at("shrinking"));
  }
  for (const Tree& turns : cell.at("turns").elements()) {
    tube.turns.push_back(turns.integer());
  }
  tube.curve = series_from(cell.at("curve"));
  tube.shape = series_from(cell.at("shape"));
  const bool is_filter = cell.find("covariance_low") != nullptr || cell.find("covariance_high") != nullptr;
  const std::size_t states = is_filter ? estimated : all_states;
  if (is_filter) {
    tube.covariance_low = series_from(cell.at("covariance_low"));
    tube.covariance_high = series_from(cell.at("covariance_high"));
    if (estimated == 0 || tube.covariance_low.size() != tube.shape.size() ||
        tube.covariance_high.size() != tube.shape.size()) {
      objections.emplace_back("bounds of a covariance are for filters, of as many entries as the shape has");
    }
  }
  if (const Tree* entry = cell.find("entry")) {
    tube.entry = LongRunEntry{double_from(entry->at("margin")), double_from(entry->at("ratio"))};
    if (!certainly_positive(Ball(tube.entry->margin)) || !certainly_less(Ball(tube.entry->margin), one) ||
        !certainly_at_most(one, Ball(tube.entry->ratio))) {
      objections.emplace_back("a margin is between 0 and 1, and a ratio at least 1");
    }
  }
  tube.phases = power_of_two_from(cell.at("phases"), objections);
  tube.frequencies = power_of_two_from(cell.at("frequencies"), objections);
  if (tube.turns.size() != states || tube.curve.size() != states ||
      tube.shape.size() != states * (states + 1) / 2) {
    objections.emplace_back("a curve or a shape that is not of as many states as the tracker has");
  }
  if (!certainly_positive(Ball(tube.half_width))) {
    objections.emplace_back("the half width of a cell is not positive");
  }
  if (!is_falling(tube.levels)) {
    objections.emplace_back("levels fall and are positive");
  }
  if (shrinks ? !is_shrinking(tube) : tube.levels.size() != 1) {
    objections.emplace_back(shrinks ? "rates of shrinking are for each pair of levels, positive and below 1"
                                    : "a tube in Gaussian noise has one level");
  }
  constexpr long kMostTurns = 1000;
  if (std::any_of(tube.turns.begin(), tube.turns.end(),
                  [](long turns) { return turns > kMostTurns || turns < -kMostTurns; })) {
    objections.emplace_back("too many turns");
  }
  return tube;
}

AmplitudePart amplitudes_from(const Tree& tree, Objections& objections) {
  const std::vector<double> ends = doubles_from(tree);
  if (ends.size() != 2) {
    throw Malformed("a part of the amplitudes has two ends");
  }
  if (!certainly_positive(Ball(ends[0])) || !certainly_less(Ball(ends[0]), Ball(ends[1]))) {
    objections.emplace_back("the amplitudes of a part are positive and go from low to high");
  }
  return {ends[0], ends[1]};
}

GaussianTerms terms_from(const Tree& tree, Objections& objections) {
  GaussianTerms terms;
  for (const auto& [name, member] :
       {std::pair("deviation", &GaussianTerms::deviation),
        std::pair("most_noise", &GaussianTerms::most_noise), std::pair("exponent", &GaussianTerms::exponent),
        std::pair("factor", &GaussianTerms::factor), std::pair("constant", &GaussianTerms::constant)}) {
    terms.*member = double_from(tree.at(name));
    if (!certainly_positive(Ball(terms.*member))) {
      objections.push_back(std::string("gaussian: ") + name + " must be positive");
    }
  }
  if (!certainly_less(Ball(terms.factor), one)) {
    objections.emplace_back("gaussian: factor must be below 1");
  }
  return terms;
}

}  // namespace

Ball low_end(const PhaseTube& tube) {
  return Ball(tube.frequency) - Ball(tube.half_width);
}
Ball high_end(const PhaseTube& tube) {
  return Ball(tube.frequency) + Ball(tube.half_width);
}

TubeSet read_tube_set(const Tree& set, std::size_t states, Objections& objections, std::size_t estimated) {
  TubeSet result;
  result.name = set.at("name").text();
  if (const Tree* amplitudes = set.find("amplitude")) {
    result.amplitudes = amplitudes_from(*amplitudes, objections);
  }
  if (const Tree* terms = set.find("gaussian")) {
    result.gaussian = terms_from(*terms, objections);
  } else {
    result.slew = double_from(set.at("slew"));
    result.noise = double_from(set.at("noise"));
  }
  if (!certainly_not_negative(Ball(result.slew)) || !certainly_not_negative(Ball(result.noise))) {
    objections.emplace_back("slew and noise must not be negative");
  }
  if (certainly_positive(Ball(result.slew))) {
    result.crossing = doubles_from(set.at("crossing"));
  }
  for (const Tree& cell : set.at("cells").elements()) {
    result.tubes.push_back(tube_from(cell, states, estimated, !result.gaussian, objections));
    if (result.tubes.back().covariance_high.empty() != result.tubes.front().covariance_high.empty()) {
      objections.emplace_back("some cells bound a covariance, and others do not");
    }
  }
  for (const PhaseTube& tube : result.tubes) {
    if (tube.entry.has_value() != (result.name == kLongRun) || (tube.entry && !bounds_covariance(result))) {
      objections.emplace_back(
          "tubes of a filter in the long run, and only these, say how bounds of a covariance are reached");
      break;
    }
  }
  if (bounds_covariance(result) && certainly_positive(Ball(result.slew))) {
    result.margin = double_from(set.at("margin"));
    if (!certainly_positive(Ball(result.margin)) || !certainly_less(Ball(result.margin), one)) {
      objections.emplace_back("a margin is between 0 and 1");
    }
  }
  if (result.tubes.empty()) {
    objections.emplace_back("a set without cells");
  }
  return result;
}

void check_order(const TubeSet& set, Objections& objections) {
  for (std::size_t i = 0; i + 1 < set.tubes.size(); ++i) {
    // In order, so that nothing between two neighbours is missed.
    if (!certainly_less(Ball(set.tubes[i].frequency), Ball(set.tubes[i + 1].frequency)) ||
        !certainly_at_most(low_end(set.tubes[i + 1]), high_end(set.tubes[i]))) {
      objections.emplace_back("the cells do not go from low frequencies to high ones without gaps");
      return;
    }
  }
}

bool covers(const TubeSet& set, const Ball& lowest, const Ball& highest CHECKER_DECLARED_PLACE) {
  CHECKER_IF_FORCED
  return !set.tubes.empty() && certainly_at_most(low_end(set.tubes.front()), lowest) &&
         certainly_at_most(highest, high_end(set.tubes.back()));
}

}  // namespace veritrack::checker
