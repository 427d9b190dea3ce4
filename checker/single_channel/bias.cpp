#include "checker/single_channel/bias.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "checker/document/evidence.hpp"
#include "checker/single_channel/invariant_curve.hpp"

namespace veritrack::checker {

namespace {

const Ball whole_band = Ball::within(one);

/// The meaning of "around", rad/sample, and a double above it, with room for a frequency that is not a
/// double.
const Ball& around() {
  static const Ball width = from_decimal("0.002");
  return width;
}
constexpr double kHalfWidth = 0.002 + 0x1p-40;

/// One component of the curves, as a function of the phase and of t.
class Component {
 public:
  Component(const CurveFamily& family, slong row, double sign) : harmonics_(family.harmonics) {
    for (const Matrix& term : family.terms) {
      Matrix& mine = terms_.emplace_back(1, term.columns());
      for (slong k = 0; k < term.columns(); ++k) {
        mine.set(0, k, Ball(sign) * term(row, k));
      }
    }
  }

  [[nodiscard]] Ball mean(const Ball& t) const {
    return horner([](const Matrix& term) { return term(0, 0); }, t);
  }
  /// The values, or the derivatives by the phase, at all points of a ball.
  [[nodiscard]] Ball at(const Ball& phase, const Ball& t, slong derivative = 0) const {
    const Matrix b = waves(harmonics_, phase, one, derivative + 1);
    return horner([&](const Matrix& term) { return (term * b)(0, derivative); }, t);
  }

  /// True only when the component exceeds `bound` at all phases and all t.
  [[nodiscard]] bool exceeds(const Ball& bound, const Ball& t) const {
    const auto parts = static_cast<std::size_t>(4 * harmonics_);
    for (std::size_t part = 0; part < parts; ++part) {
      const Ball cell = part_of_period(part, parts);
      if (!exceeds(bound, t, cell.lower(), cell.upper(), kDepth)) {
        return false;
      }
    }
    return true;
  }

  /// A phase near that of the smallest value at t = 0: a proposal.
  [[nodiscard]] double lowest_phase() const {
    constexpr int kPhases = 4096;
    double best = HUGE_VAL;
    double best_phase = 0.0;
    for (int i = 0; i < kPhases; ++i) {
      const double phase = std::numbers::pi * i / kPhases;
      double value = 0.0;
      for (slong k = 1; k <= harmonics_; ++k) {
        const double angle = 2.0 * static_cast<double>(k) * phase;
        value +=
            terms_[0](0, 2 * k - 1).near() * std::cos(angle) + terms_[0](0, 2 * k).near() * std::sin(angle);
      }
      if (value < best) {
        best = value;
        best_phase = phase;
      }
    }
    return best_phase;
  }

 private:
  static constexpr int kDepth = 30;

  template <typename Value>
  [[nodiscard]] Ball horner(const Value& value, const Ball& t) const {
    Ball sum = value(terms_.back());
    for (std::size_t k = terms_.size() - 1; k > 0; --k) {
      sum = sum * t + value(terms_[k - 1]);
    }
    return sum;
  }
  [[nodiscard]] bool exceeds(const Ball& bound, const Ball& t, const Ball& low, const Ball& high,
                             int depth) const {
    const Ball cell = Ball::hull(low, high);
    const Ball middle = (half * (low + high)).lower();
    if (certainly_less(bound, at(middle, t) + (cell - middle) * at(cell, t, 1))) {
      return true;
    }
    return depth > 0 && exceeds(bound, t, low, middle, depth - 1) &&
           exceeds(bound, t, middle, high, depth - 1);
  }

  slong harmonics_;
  std::vector<Matrix> terms_;
};

/// The parts of the t in question, narrow enough for Horner's scheme.
std::vector<Ball> parts_of(const Ball& t) {
  // cannot bind (t.upper() - t.lower()): one part is right, too; more are sharper.
  if (!certainly_less(t.upper() - t.lower(), one)) {
    return {Ball::hull(Ball(-1.0), Ball(-0.5)), Ball::hull(Ball(-0.5), zero), Ball::hull(zero, half),
            Ball::hull(half, one)};
  }
  return {t};
}

/// The smallest value over the phase, for each t: at least the `claimed` bound if that is true, and at most
/// the value at one phase.
Range smallest(const Component& component, const Ball& t, const Ball& distance, const Ball& claimed) {
  bool above = true;
  Ball attained = Ball(-HUGE_VAL);
  const Ball phase(component.lowest_phase());
  for (const Ball& part : parts_of(t)) {
    above = above && component.exceeds(claimed + distance, part);
    attained = max(attained, (component.at(phase, part) + distance).upper());
  }
  return {above ? claimed : Ball::everything(), attained};
}

/// The quantities of one kind: at the frequency ("") or around it ("_around").
void add_errors(const Tree& quantities, const std::string& suffix, const CurveFamily& family, const Ball& t,
                const Ball& distance, Derivation& found) {
  const auto row = static_cast<slong>(2);
  const Component error(family, row, 1.0);
  const Component negative(family, row, -1.0);
  const Ball mean = error.mean(t);
  found.quantities.push_back({"mean_bias" + suffix, {mean - distance, mean + distance}});
  if (const Tree* claimed = quantities.find("min_error" + suffix)) {
    const Range range = smallest(error, t, distance, low_of(*claimed));
    found.quantities.push_back({"min_error" + suffix, range});
  }
  if (const Tree* claimed = quantities.find("max_error" + suffix)) {
    const Range range = smallest(negative, t, distance, -high_of(*claimed));
    found.quantities.push_back({"max_error" + suffix, {-range.high, -range.low}});
  }
}

/// On the curve the estimate stays within a quarter turn of the signal: Re(1 + delta) > 0.
bool locked(const InvariantCurve& curve, const Ball& t, const Ball& distance) {
  const std::vector<Ball> parts = parts_of(t);
  return std::all_of(parts.begin(), parts.end(), [&](const Ball& part) {
    return Component(curve.family, 0, 1.0).exceeds(distance - one, part);
  });
}

/// Whether the steady state at `frequency` (rad/sample) of the design with epsilon = 0 has no error.
bool exact_without_leak(const SingleChannelDesign& design, const Ball& frequency) {
  return certainly_positive(design.q1) && certainly_positive(design.q2) && certainly_positive(design.r) &&
         certainly_positive(frequency) && certainly_less(frequency, pi());
}

}  // namespace

std::optional<SteadyStateBias> check_bias(const Tree& claimed, const SingleChannelDesign& design,
                                          QuadratureBranch& quadrature, Objections& objections) {
  const Tree& quantities = claimed.at("quantities");
  Derivation found;
  found.title = "Steady-state frequency error on a noise-free tone";
  const Ball frequency = read_enclosure(quantities.at("frequency"), "frequency", objections);
  const std::string& id = claimed.at("id").text();
  const std::size_t slash = id.find('/');
  const Tree& ends = quantities.at("frequency");
  found.quantities.push_back({"frequency", slash != std::string::npos
                                               ? Range(from_decimal(id.substr(slash + 1)))
                                               : Range(low_of(ends), high_of(ends))});
  const bool no_leak = design.without_leak();
  if (quantities.find("quadrature_bias") != nullptr) {
    // Without a leak the exact estimate is a fixed point at every frequency.
    found.quantities.push_back({"quadrature_bias", no_leak ? zero : quadrature.error_at(frequency)});
  }

  const bool undecided = claimed.at("conditions").elements().empty();
  bool established = false;
  const auto add_zeros = [&] {
    const bool exact = exact_without_leak(design, frequency + Ball::within(around()));
    for (const char* name : {"mean_bias", "min_error", "max_error"}) {
      found.quantities.push_back({name, zero});
      found.quantities.push_back({std::string(name) + "_around", exact ? zero : Ball::everything()});
    }
  };
  const Tree* rate_quantity = quantities.find("contraction_rate");
  if (!undecided && no_leak && rate_quantity == nullptr && exact_without_leak(design, frequency)) {
    // The argument at the top of bias.hpp; no rate is claimed.
    established = true;
    add_zeros();
  } else if (!undecided) {
    constexpr double kAnyRate = 0.99;
    const Ball rate = rate_quantity == nullptr ? Ball(kAnyRate) : high_of(*rate_quantity);
    const bool has_around = !no_leak && quantities.find("mean_bias_around") != nullptr;
    const auto curve = establish_invariant_curve({design.q1, design.q2, design.r, design.epsilon}, frequency,
                                                 has_around ? kHalfWidth : 0.0, rate);
    const std::size_t error = 2;
    if (curve && no_leak) {
      // The errors of C are zero, and the step keeps them so.
      established = true;
      add_zeros();
    } else if (curve) {
      established = locked(*curve, curve->here, curve->near_here[0]);
      add_errors(quantities, "", curve->family, curve->here, curve->near_here[error], found);
      if (has_around && locked(*curve, whole_band, curve->distance[0])) {
        add_errors(quantities, "_around", curve->family, whole_band, curve->distance[error], found);
      }
    }
    if (established) {
      found.quantities.push_back({"contraction_rate", {zero, rate}});
    }
  }
  found.conditions = {
      {"invariant-curve", R"(X_*(\varphi + \omega) = G_\varphi(X_*(\varphi)))", proved_if(established)}};
  check_derivation(claimed, found, objections);
  const auto mean = std::find_if(found.quantities.begin(), found.quantities.end(),
                                 [](const Quantity& quantity) { return quantity.name == "mean_bias"; });
  if (!established || mean == found.quantities.end()) {
    return std::nullopt;
  }
  return SteadyStateBias{{low_of(ends), high_of(ends)}, mean->value};
}

Claim check_proposition_1(const Tree& claim, const SingleChannelDesign& design,
                          const std::vector<SteadyStateBias>& established, Objections& objections) {
  const std::string& text = claim.at("frequency").text();
  const Ball frequency = from_decimal(text);
  Claim found;
  if (claim.at("id").text() == "proposition-1/if") {
    found = {
        "With ε = 0 the steady state on a noise-free tone of " + text + " rad/sample has no frequency error.",
        proved_if(exact_without_leak(design, frequency)),
        {}};
  } else {
    const auto bias =
        std::find_if(established.begin(), established.end(), [&](const SteadyStateBias& one_bias) {
          return certainly_at_most(one_bias.frequency.low, frequency) &&
                 certainly_at_most(frequency, one_bias.frequency.high);
        });
    const Range mean = bias != established.end() ? bias->mean : Range(Ball::everything());
    const bool biased = certainly_less(mean.high, zero) || certainly_less(zero, mean.low);
    found = {"With the design's ε the steady state on a noise-free tone of " + text +
                 " rad/sample has a mean frequency error other than 0.",
             proved_if(biased),
             {{"mean_bias", mean}}};
  }
  check_claim(claim, found, objections);
  return found;
}

}  // namespace veritrack::checker
