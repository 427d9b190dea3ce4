#include "analysis/model/gain/loop_rounding.hpp"

#include <cmath>
#include <utility>

namespace veritrack::model {

using rigor::Interval;

LoopRounding rounding_within(std::vector<double> room, const RoundingOfStep& rounding,
                             const TrackerModel& tracker, const std::vector<SteadyValue>& steady,
                             const Interval& band) {
  std::vector<Interval> states;
  for (std::size_t i = 0; i < steady.size(); ++i) {
    const SteadyValue& each = steady[i];
    if (each.imaginary || (each.turns != 0 && !tracker.recursion->is_angle[i])) {
      throw NoRounding("it keeps vectors or phases in states that are no angles");
    }
    states.push_back(Interval(each.constant) + Interval(each.per_frequency) * band +
                     Interval::from_bounds(-room[i], room[i]));
  }
  const double most = 2.0 * tracker.amplitude.upper();
  std::vector<double> found = rounding(states, Interval::from_bounds(-most, most));
  LoopRounding result{std::move(room),
                      found,
                      found.back(),
                      0.0,
                      tracker.amplitude.upper(),
                      rigor::mul_down(kMostNoise, tracker.amplitude.lower())};
  result.next.pop_back();
  return result;
}

void add_rounding(LoopNetwork& network, const LoopRounding& rounding) {
  const std::size_t n = network.a.size();
  network.turned = rounding.turned;
  network.largest_amplitude = rounding.amplitude;
  // The frequency error stays the last form.
  const linear::Row error = network.forms.back();
  const std::vector<DirectTerm> direct = network.direct.back();
  const double ripple = network.ripple.back();
  network.forms.pop_back();
  network.direct.pop_back();
  network.ripple.pop_back();
  network.ripple_at_start.resize(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    linear::Row unit(n, Interval(0.0));
    unit[i] = Interval(1.0);
    for (const LoopNetwork::TurningPart& part : network.turning) {
      // The form behind that of an angle is its change in a sample.
      network.direct[part.angle + 1].push_back(
          {network.inputs.size(), rigor::magnitude(network.forms[part.angle][i])});
    }
    network.columns.push_back({{unit}});
    network.inputs.push_back({NetworkInput::Cause::rounding, "",
                              [size = rounding.next[i]](double /*noise*/, double /*slew*/,
                                                        const auto& /*bounds*/) { return size; }});
    network.state_forms.push_back(network.forms.size());
    if (std::isfinite(rounding.room[i])) {
      network.limits.emplace_back(network.forms.size(), rounding.room[i]);
    }
    network.forms.push_back(std::move(unit));
    network.direct.emplace_back();
    network.ripple.push_back(network.ripple_at_start[i]);
    network.ripple_at_start[i] =
        rigor::add_up(network.ripple_at_start[i], rounding.next[i]);  // the start is rounded
  }
  network.forms.push_back(error);
  network.direct.push_back(direct);
  network.ripple.push_back(ripple);
  network.rounding_of_frequency = rounding.frequency;
  network.most_noise = rounding.most_noise;
}

}  // namespace veritrack::model
