// The elementary functions lane by lane, for any processor.
#include "analysis/rigor/interval_lanes.hpp"

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/elementary_ratios.hpp"
#include "analysis/rigor/quarter_turns.hpp"

namespace veritrack::rigor::detail {

namespace {

template <typename Function>
void each_lane(int count, const LaneBounds& x, LaneBounds& result, const Function& function) {
  for (int i = 0; i < count; ++i) {
    const Interval found = function(Interval::from_bounds(x.lower[i], x.upper[i]));
    result.lower[i] = found.lower();
    result.upper[i] = found.upper();
  }
}

}  // namespace

void sine_ratio_of_lanes(int count, const LaneBounds& x, LaneBounds& result) {
  each_lane(count, x, result, [](const Interval& lane) { return sine_ratio(lane); });
}
void sine_ratio_slope_of_lanes(int count, const LaneBounds& x, LaneBounds& result) {
  each_lane(count, x, result, [](const Interval& lane) { return sine_ratio_slope(lane); });
}
void arctangent_ratio_of_lanes(int count, const LaneBounds& x, LaneBounds& result) {
  each_lane(count, x, result, [](const Interval& lane) { return arctangent_ratio(lane); });
}
void arctangent_ratio_slope_of_lanes(int count, const LaneBounds& x, LaneBounds& result) {
  each_lane(count, x, result, [](const Interval& lane) { return arctangent_ratio_slope(lane); });
}
void quarter_turns_of_lanes(int count, const LaneBounds& x, double (*flags)[LaneBounds::kMost]) {
  for (int i = 0; i < count; ++i) {
    for (int residue = 0; residue < 4; ++residue) {
      const Interval lane = Interval::from_bounds(x.lower[i], x.upper[i]);
      flags[residue][i] = may_contain_quarter_turn(lane, residue, 4) ? 1.0 : 0.0;
    }
  }
}
void sin_cos_of_lanes(int count, const LaneBounds& x, LaneBounds& sine, LaneBounds& cosine) {
  for (int i = 0; i < count; ++i) {
    const auto [s, c] = sin_cos(Interval::from_bounds(x.lower[i], x.upper[i]));
    sine.lower[i] = s.lower();
    sine.upper[i] = s.upper();
    cosine.lower[i] = c.lower();
    cosine.upper[i] = c.upper();
  }
}

}  // namespace veritrack::rigor::detail
