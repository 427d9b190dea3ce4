// The noise of a sample as one input, wherever it comes in: docs/gain-proof.md, section 2.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "analysis/model/gain/frame_rules.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

using rigor::Interval;

namespace {

/// At most |(1 + z)^a (1 + conj z)^b - 1 - a z - b conj z| for |z| <= share, a + b = magnitude, a - b =
/// order: by the powers of the series, whose coefficients are at most those of the function of `share` that
/// is used.
double curvature_of_power(int magnitude, int order, const Interval& share) {
  if (!rigor::certainly_less(share, Interval(1.0))) {
    return INFINITY;
  }
  const int most = std::max(std::abs(magnitude), std::abs(order));
  const bool is_polynomial = std::abs(order) <= magnitude && (magnitude + order) % 2 == 0;
  const Interval whole = is_polynomial ? FrameRules::whole_power(Interval(1.0) + share, most)
                                       : FrameRules::whole_power(Interval(1.0) - share, -most);
  const Interval rest = whole - Interval(1.0) - Interval(static_cast<double>(most)) * share;
  return std::max(rest.upper(), 0.0);
}

}  // namespace

int FrameRules::shared_noise(Frame& frame) {
  if (frame.noise_input_ < 0) {
    FrameInput input;
    input.components = 2;
    input.at_noise = [amplitude = frame.amplitude_](double noise) {
      return noise < amplitude.lower() ? noise : INFINITY;
    };
    frame.noise_input_ = add_input(frame, std::move(input));
    FrameLine real;
    add_component(real, frame.noise_input_, Interval(1.0));
    frame.noise_form_ = add_form(frame, real);
  }
  return frame.noise_input_;
}

void FrameRules::add_shared_noise(Frame& frame, FrameLine& line, const Monomial& monomial,
                                  const FrameLine& phase, int part) {
  const int s = monomial.magnitude;
  const int m = monomial.order;
  const int noise = shared_noise(frame);
  // e^(i beta) A^(s - 1) (s Re n + i m Im n).
  const Interval base = base_of(phase, frame.band_);
  const Interval power = whole_power(frame.amplitude_, s - 1);
  const Interval along = Interval(static_cast<double>(s)) * power;
  const Interval across = Interval(static_cast<double>(m)) * power;
  const Interval cosine = rigor::cos(base);
  const Interval sine = rigor::sin(base);
  add_component(line, noise, along * (part == 0 ? cosine : sine));
  add_component(line, noise + 1, across * (part == 0 ? -sine : cosine));
  const bool turns = !phase.is_form_empty();
  if (!turns && std::abs(m) == 1 && s == 1) {
    return;  // M = e^(i beta) (A + n)
  }
  const auto found = frame.discs_.find(monomial);
  if (found != frame.discs_.end()) {
    add_component(line, found->second + part, Interval(1.0));
    return;
  }
  const Interval size = Interval(rigor::magnitude(whole_power(frame.amplitude_, s)));
  const Interval least(frame.amplitude_.lower());
  const double most = std::max(std::abs(s), std::abs(m));
  const auto curved = [size, least, s, m](double at) {
    return (size * Interval(curvature_of_power(s, m, Interval(at) / least))).upper();
  };
  FrameInput input;
  input.components = monomial.is_real() ? 1 : 2;
  if (turns) {
    const auto angle = static_cast<std::size_t>(form_of_phase(frame, monomial, phase));
    const auto of_noise = static_cast<std::size_t>(frame.noise_form_);
    input.is_remainder = true;
    input.what = "noise at a phase that is off";
    input.at_bounds = [curved, size, least, most, angle, of_noise](const std::vector<double>& bounds) {
      const double at = bounds[of_noise];
      if (!(at < INFINITY) || !(bounds[angle] < INFINITY)) {
        return static_cast<double>(INFINITY);
      }
      const Interval turned(std::min(0.5 * bounds[angle], 1.5));
      const Interval chord = bounds[angle] < 3.0 ? Interval(2.0) * rigor::sin(turned) : Interval(2.0);
      return rigor::add_up(curved(at), (size * Interval(most) * Interval(at) / least * chord).upper());
    };
  } else {
    input.at_noise = curved;
  }
  frame.discs_[monomial] = add_input(frame, std::move(input));
  add_component(line, frame.discs_[monomial] + part, Interval(1.0));
}

void FrameRules::add_shared_angle(Frame& frame, FrameLine& line, double multiple) {
  const int noise = shared_noise(frame);
  if (frame.angle_input_ < 0) {
    FrameInput input;
    input.at_noise = [least = Interval(frame.amplitude_.lower())](double at) {
      const Interval share = Interval(at) / least;
      // |Im log(1 + z) - Im z| <= -log(1 - |z|) - |z|.
      return rigor::certainly_less(share, Interval(1.0))
                 ? std::max((-rigor::log(Interval(1.0) - share) - share).upper(), 0.0)
                 : INFINITY;
    };
    frame.angle_input_ = add_input(frame, std::move(input));
  }
  add_component(line, noise + 1, Interval(multiple) / frame.amplitude_);
  add_component(line, frame.angle_input_, Interval(multiple));
}

}  // namespace veritrack::model
