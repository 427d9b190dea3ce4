#include "checker/model/tube_family.hpp"

namespace veritrack::checker {

TrackedModel on_amplitudes_of(const TubeSet& set, const TrackedModel& model, const ModelDesign& design,
                              Objections& objections) {
  if (set.amplitudes.has_value() != design.is_constant_in_range) {
    objections.emplace_back(
        design.is_constant_in_range
            ? "a constant amplitude of a range is in a part of it, and the set says no part"
            : "parts of amplitudes are for a constant one that is known to be in a range");
    return model;
  }
  TrackedModel result = model;
  if (set.amplitudes) {
    result.amplitude = Ball::hull(Ball(set.amplitudes->low), Ball(set.amplitudes->high));
    result.amplitude_varies = true;
  }
  return result;
}

void check_amplitudes(const std::vector<TubeSet>& sets, const ModelDesign& design, Objections& objections) {
  if (!design.is_constant_in_range) {
    if (sets.size() != 1) {
      objections.emplace_back("a second set of this name");
    }
    return;
  }
  bool is_cover = !sets.empty();
  for (std::size_t i = 0; i < sets.size() && is_cover; ++i) {
    is_cover = sets[i].amplitudes.has_value() &&
               (i == 0 || (sets[i - 1].amplitudes->low < sets[i].amplitudes->low &&
                           sets[i].amplitudes->low <= sets[i - 1].amplitudes->high));
  }
  is_cover = is_cover && certainly_at_most(Ball(sets.front().amplitudes->low), design.least_amplitude) &&
             certainly_at_most(design.largest_amplitude, Ball(sets.back().amplitudes->high));
  if (!is_cover) {
    objections.emplace_back(
        "the parts do not go from low amplitudes to high ones without gaps, over the range of the design");
  }
}

void check_same_parts(const std::vector<TubeSet>& sets, const std::vector<TubeSet>& others,
                      Objections& objections) {
  const bool are_same = std::equal(
      sets.begin(), sets.end(), others.begin(), others.end(), [](const TubeSet& a, const TubeSet& b) {
        return a.amplitudes.has_value() == b.amplitudes.has_value() &&
               (!a.amplitudes || (certainly_equal(Ball(a.amplitudes->low), Ball(b.amplitudes->low)) &&
                                  certainly_equal(Ball(a.amplitudes->high), Ball(b.amplitudes->high))));
      });
  if (!are_same || sets.empty()) {
    objections.emplace_back("its parts of the amplitudes are not those of the set around it");
  }
}

}  // namespace veritrack::checker
