// The angles and the limits of a frame.
#include "checker/model/gain/linear_frame.hpp"

#include <cmath>
#include <string>

#include "checker/model/formula.hpp"

namespace veritrack::checker {

namespace {

/// At least |arg(1 + u + i v) - v| for |u| and |v| at most these; everything where u may be -1, or the angle
/// as far as `room` from 0.
Ball remainder_of_direction(const Ball& u, const Ball& v, const Ball& room) {
  const Ball nearest = one - u;
  if (!certainly_positive(nearest) || !certainly_less(arctangent(v / nearest), room)) {
    return Ball::everything();
  }
  // atan(v/(1 - u)) - v has its maximum at this v.
  const Ball top = sqrt(u * nearest);
  const Ball at = certainly_less(v, top) ? v : top;
  return max(arctangent(at / nearest) - at, v - arctangent(v / (one + u)));
}

}  // namespace

std::array<int, 2> LinearFrame::relative_to_direction(int y, int x) {
  const LinearValue imaginary = at(y);
  const LinearValue real = at(x);
  require_plain(imaginary);
  require_plain(real);
  const Ball of_y = base(imaginary);
  const Ball of_x = base(real);
  const Ball squares = square(of_y) + square(of_x);
  LinearValue along;
  add_deviations(along, real, of_x / squares);
  add_deviations(along, imaginary, of_y / squares);
  LinearValue across;
  add_deviations(across, imaginary, of_x / squares);
  add_deviations(across, real, -(of_y / squares));
  const std::string of = std::to_string(y) + " " + std::to_string(x);
  return {made("along " + of, [&] { return along; }), made("across " + of, [&] { return across; })};
}

/// atan2 is that of the steady values plus that of 1 + u + i v, where u and v are what deviates along their
/// direction and across it, relative to their length.
int LinearFrame::direction(int y, int x) {
  return made("atan2 " + std::to_string(y) + " " + std::to_string(x), [&] {
    const auto [u, v] = relative_to_direction(y, x);
    LinearValue result = at(v);
    result.constant = arctangent2(base(at(y)), base(at(x)));
    if (!at(u).deviations.empty() || !at(v).deviations.empty()) {
      const Ball room = pi() - abs(result.constant);
      const std::size_t source = add_input({nullptr, {u, v}, [room](const std::vector<Ball>& bounds) {
                                              return remainder_of_direction(bounds.at(0), bounds.at(1), room);
                                            }});
      result.deviations[source] = {one, zero};
    }
    return result;
  });
}

/// The length is L |1 + u + i v|, with L = x + (L - x) in the steady state.
int LinearFrame::length(int y, int x) {
  return made("length " + std::to_string(y) + " " + std::to_string(x), [&] {
    const LinearValue real = at(x);
    const Ball of_x = base(real);
    const Ball squared = square(base(at(y)));
    const Ball whole = sqrt(squared + square(of_x));
    if (!certainly_positive(of_x)) {
      throw NotCovered("a vector that may be turned back");
    }
    const auto [u, v] = relative_to_direction(y, x);
    LinearValue result;
    result.constant = real.constant + squared / (whole + of_x);  // L - x, whose widths are not added
    result.per_frequency = real.per_frequency;
    add_deviations(result, at(u), whole);
    if (!at(u).deviations.empty() || !at(v).deviations.empty()) {
      const std::size_t source =
          add_input({nullptr, {u, v}, [whole = whole.upper()](const std::vector<Ball>& bounds) {
                       const Ball nearest = one - bounds.at(0);
                       return whole * (sqrt(square(nearest) + square(bounds.at(1))) - nearest);
                     }});
      result.deviations[source] = {one, zero};
    }
    return result;
  });
}

int LinearFrame::sample_phase() {
  return made("sample phase", [] { return LinearValue{1, zero, one, {}, true}; });
}

int LinearFrame::quarter_turns(int count) {
  return made("quarters " + std::to_string(count), [&] {
    return LinearValue{0, pi() * Ball(count) * half, zero, {}, false};
  });
}

int LinearFrame::noise_angle() {
  if (has_one_noise_) {
    return made("angle of the noise", [this] {
      // Im log(1 + z), z = n/A: its series after Im z is below that of -log(1 - |z|) after |z|.
      const Ball least = least_;
      const std::size_t rest =
          add_input({[least](const Ball& noise) {
                       const Ball z = noise / least;
                       return certainly_less(z, one) ? -log(one - z) - z : Ball::everything();
                     },
                     {},
                     nullptr});
      LinearValue value;
      add_deviations(value, at(noise_part(1)), one / Ball::hull(least_, largest_));
      value.deviations[rest] = {one, zero};
      return value;
    });
  }
  return made("noise angle", [this] {
    const Ball least = least_;
    const std::size_t source =
        add_input({[least](const Ball& noise) { return arcsine(noise / least); }, {}, nullptr});
    LinearValue value;
    value.deviations[source] = {one, zero};
    return value;
  });
}

int LinearFrame::noise_part(std::size_t part) {
  return made("noise part " + std::to_string(part), [&] {
    const std::size_t source = named_input("the noise", [] {
      return FrameInput{[](const Ball& noise) { return noise; }, {}, nullptr};
    });
    LinearValue value;
    value.deviations[source] = part == 0 ? InputFactor{one, zero} : InputFactor{zero, one};
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

bool LinearFrame::stays_positive(int x) {
  if (!at(x).is_plain() || !certainly_positive(base(at(x)))) {
    return false;
  }
  if (!names_.contains("positive " + std::to_string(x))) {
    names_["positive " + std::to_string(x)] = x;
    limit(x, zero, Ball(0x1p64));  // 2^64 is no limit
  }
  return true;
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
