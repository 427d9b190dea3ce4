// The angles and the limits of a frame.
#include "checker/model/gain/linear_frame.hpp"

#include <cmath>
#include <string>

namespace veritrack::checker {

int LinearFrame::sample_phase() {
  return made("sample phase", [] { return LinearValue{1, zero, one, {}, true}; });
}

int LinearFrame::quarter_turns(int count) {
  return made("quarters " + std::to_string(count), [&] {
    return LinearValue{0, pi() * Ball(count) * half, zero, {}, false};
  });
}

int LinearFrame::noise_angle() {
  return made("noise angle", [this] {
    const Ball least = least_;
    const std::size_t source =
        add_input({[least](const Ball& noise) { return arcsine(noise / least); }, {}, nullptr});
    LinearValue value;
    value.deviations[source] = {one, zero};
    return value;
  });
}

void LinearFrame::limit(int x, const Ball& low, const Ball& high) {
  limits_.push_back({x, base(at(x)), low, high});
}

int LinearFrame::stays_within(int x, int low, int high) {
  for (const int each : {x, low, high}) {
    require_plain(at(each));
  }
  const int least = sum(x, negated(low));
  const int most = sum(high, negated(x));
  // 2^64 is no limit.
  limit(least, zero, Ball(0x1p64));
  limit(most, zero, Ball(0x1p64));
  return x;
}

int LinearFrame::modulo_turn(int x) {
  return made("modulo " + std::to_string(x), [&] {
    LinearValue value = at(x);
    value.is_modulo_turn = true;
    return value;
  });
}

int LinearFrame::principal(int x, const Ball& period) {
  const std::string name = "principal " + period.text(6) + " " + std::to_string(x);
  const bool is_new = !names_.contains(name);
  const int result = made(name, [&] {
    LinearValue value = at(x);
    value.constant -= Ball(std::round((base(value) / period).near())) * period;
    value.is_modulo_turn = false;
    return value;
  });
  if (is_new) {
    limit(result, -(period * half), period * half);
    note_angle(result);
  }
  return result;
}

}  // namespace veritrack::checker
