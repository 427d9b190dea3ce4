// Functions with kinks in the frame of the signal, over a band and with deviations of every size: true values
// lie within the line and the remainder at what deviations are, and reach them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

/// Two states that are c + b omega + a deviation, over a band.
struct KinkCase {
  double constant[2], slope[2], low, high, deviation[2];

  explicit KinkCase(test::Random& random) {
    for (std::size_t i = 0; i < 2; ++i) {
      constant[i] = random.uniform(-1.0, 1.0);
      slope[i] = random.below(2) == 0 ? 0.0 : random.uniform(-1.0, 1.0);
      deviation[i] = random.uniform(-1.5, 1.5);
    }
    low = random.uniform(-0.5, 0.4);
    high = random.below(3) == 0 ? low : random.uniform(low, 0.5);
  }
  [[nodiscard]] double value(std::size_t i, double omega) const {
    return constant[i] + slope[i] * omega + deviation[i];
  }
};

using FrameFormula = std::function<FrameValue(const FrameValue&, const FrameValue&, Frame&)>;

/// The largest share of the remainder that true values reach. `truth` is NAN where a limit is not kept.
double attack_kink(const FrameFormula& formula, const std::function<double(double, double)>& truth,
                   std::uint64_t stream) {
  const rigor::UpwardRounding upward;
  test::Random random(stream);
  double reached = 0.0;
  std::int64_t known = 0;
  const std::int64_t trials = test::effort(4000);
  for (std::int64_t trial = 0; trial < trials; ++trial) {
    const KinkCase at(random);
    Frame frame(Interval(1.0), Interval::from_bounds(at.low, at.high), 2);
    const FrameValue x = frame.state(0, false, 0, at.constant[0], at.slope[0]);
    const FrameValue z = frame.state(1, false, 0, at.constant[1], at.slope[1]);
    FrameLine line;
    try {
      line = frame.line_of(formula(x, z, frame));
    } catch (const NoFrame&) {
      continue;
    }
    std::vector<double> sizes;
    std::vector<double> bounds;
    const auto sum = [&](const FrameLine& of) {
      double linear = 0.0;
      for (std::size_t i = 0; i < of.states.size(); ++i) {
        linear += rigor::midpoint(of.states[i]) * at.deviation[i];
      }
      return linear;
    };
    const auto room_of = [&](const FrameLine& of) {
      double room = 0.0;
      for (const auto& [component, weight] : of.inputs) {
        room += rigor::magnitude(weight) * sizes.at(static_cast<std::size_t>(component));
      }
      return room;
    };
    // Each form is about states and earlier remainders.
    sizes.assign(frame.inputs().size(), 0.0);
    for (std::size_t round = 0; round <= sizes.size(); ++round) {
      bounds.clear();
      for (const FrameLine& form : frame.forms()) {
        bounds.push_back(std::fabs(sum(form)) + room_of(form));
      }
      for (std::size_t i = 0; i < sizes.size(); ++i) {
        sizes[i] = frame.inputs()[i].at_bounds(bounds);
      }
    }
    const bool keeps_limits = std::all_of(
        frame.limits().begin(), frame.limits().end(),
        [&](const FrameLimit& limit) { return bounds[static_cast<std::size_t>(limit.form)] < limit.room; });
    if (!keeps_limits) {
      continue;
    }
    ++known;
    const double omega = random.uniform(at.low, at.high);
    const double value = truth(at.value(0, omega), at.value(1, omega));
    const double middle = rigor::midpoint(line.constant) + rigor::midpoint(line.per_frequency) * omega;
    const double far = std::fabs(value - middle - sum(line));
    const double room = room_of(line);
    REQUIRE(far <= room + 1e-12);
    reached = room > 1e-9 ? std::max(reached, far / room) : reached;
  }
  CHECK(known > trials / 10);
  return reached;
}

}  // namespace

TEST_CASE("kinks stay within their lines and remainders over a band, and reach them") {
  const auto number = [](Frame& frame, int place, double value) {
    return frame.constant(place, Interval(value));
  };
  CHECK(attack_kink([](const auto& x, const auto& z, Frame&) { return maximum(x, z); },
                    [](double x, double z) { return std::max(x, z); }, 901) > 0.99);
  CHECK(attack_kink([](const auto& x, const auto& z, Frame&) { return minimum(x, z); },
                    [](double x, double z) { return std::min(x, z); }, 902) > 0.99);
  CHECK(attack_kink([](const auto& x, const auto&, Frame&) { return absolute(x); },
                    [](double x, double) { return std::fabs(x); }, 903) > 0.99);
  CHECK(attack_kink([&](const auto& x, const auto&,
                        Frame& frame) { return clamped(x, number(frame, 0, -0.3), number(frame, 1, 0.6)); },
                    [](double x, double) { return std::clamp(x, -0.3, 0.6); }, 904) > 0.99);
  // Limits that are values, and may change places.
  CHECK(attack_kink(
            [&](const auto& x, const auto& z, Frame& frame) { return clamped(x, z, number(frame, 0, 0.5)); },
            [](double x, double z) { return x < z     ? z
                                            : x > 0.5 ? 0.5
                                                      : x; }, 905) > 0.99);
  CHECK(attack_kink(
            [&](const auto& x, const auto& z, Frame& frame) { return clamped(x, number(frame, 0, -0.5), z); },
            [](double x, double z) { return x < -0.5 ? -0.5
                                            : x > z  ? z
                                                     : x; }, 906) > 0.99);
  CHECK(attack_kink([](const auto& x, const auto& z, Frame&) { return maximum(x, minimum(z, x + z)); },
                    [](double x, double z) { return std::max(x, std::min(z, x + z)); }, 907) > 0.9);
  // Where limits are kept there is no remainder.
  CHECK(attack_kink([](const auto& x, const auto&, Frame&) { return sign_of(x); },
                    [](double x, double) { return x > 0.0 ? 1.0 : -1.0; }, 908) == 0.0);
  CHECK(attack_kink([](const auto& x, const auto& z, Frame&) { return chosen(x - z, z, x + x); },
                    [](double x, double z) { return x > z ? z : 2.0 * x; }, 909) == 0.0);
}

TEST_CASE("a steady state that is near a kink is noted, and one that is not is not") {
  const rigor::UpwardRounding upward;
  for (const auto& [distance, is_near] :
       {std::pair(1e-3, false), std::pair(-1e-3, false), std::pair(1e-6, true), std::pair(-1e-6, true),
        std::pair(0.0, true)}) {
    Frame frame(Interval(1.0), Interval(0.2), 1);
    (void)maximum(frame.state(0, false, 0, 0.5 + distance, 0.0), frame.constant(0, Interval(0.5)));
    CHECK(frame.may_rest_at_kink() == is_near);
  }
}

}  // namespace veritrack::model
