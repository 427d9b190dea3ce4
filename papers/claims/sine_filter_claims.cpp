#include "papers/claims/sine_filter_claims.hpp"

#include <array>
#include <string>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"
#include "papers/claims/signed_expression.hpp"
#include "papers/claims/sine_filter_horizon.hpp"
#include "trackers/zarchan/zarchan_ekf.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::Verdict;
using Symbol = SignedExpression;

/// Any design, with the slides' 100 steps a sample.
trackers::ZarchanDesign<Symbol> any_filter() {
  return {Symbol::symbol("TS"), Symbol::symbol("r"), Symbol::symbol("PHIS"), Symbol::symbol("PHIS2"), 100};
}

template <int Size>
using Estimate = trackers::ZarchanEstimate<Symbol, Size>;

/// Any state and any symmetric covariance.
template <int Size>
Estimate<Size> any_estimate() {
  Estimate<Size> estimate;
  for (int i = 0; i < Size; ++i) {
    estimate.state(i) = Symbol::symbol("x" + std::to_string(i));
    for (int k = i; k < Size; ++k) {
      estimate.covariance(i, k) = estimate.covariance(k, i) =
          Symbol::symbol("p" + std::to_string(i) + std::to_string(k));
    }
  }
  return estimate;
}

/// The image under a change of signs, by S x and S P S, and half a turn of the first state where there is
/// one.
template <int Size>
struct Mirror {
  std::array<bool, static_cast<std::size_t>(Size)> negates;
  bool turns = false;
  bool negates_measurement = false;

  [[nodiscard]] Estimate<Size> of(Estimate<Size> estimate) const {
    for (int i = 0; i < Size; ++i) {
      const bool here = negates.at(static_cast<std::size_t>(i));
      estimate.state(i) = here ? -estimate.state(i) : estimate.state(i);
      for (int k = 0; k < Size; ++k) {
        if (here != negates.at(static_cast<std::size_t>(k))) {
          estimate.covariance(i, k) = -estimate.covariance(i, k);
        }
      }
    }
    if (turns) {
      estimate.state(0) = estimate.state(0).half_turn_on();
    }
    return estimate;
  }
};

template <typename Filter, int Size>
Filter start_of(const Estimate<Size>& estimate) {
  if constexpr (Size == 2) {
    return Filter(any_filter(), Symbol::symbol("A"), estimate);
  } else {
    return Filter(any_filter(), estimate);
  }
}

/// Is a step of the mirrored estimate the mirrored step, as expressions?
template <typename Filter, int Size>
Verdict commutes(const Mirror<Size>& mirror) {
  const Symbol y = Symbol::symbol("y");
  auto plain = start_of<Filter, Size>(any_estimate<Size>());
  auto mirrored = start_of<Filter, Size>(mirror.of(any_estimate<Size>()));
  plain.step(y);
  mirrored.step(mirror.negates_measurement ? -y : y);
  const Estimate<Size> expected = mirror.of(plain.filtered());
  const Estimate<Size> found = mirrored.filtered();
  bool all = true;
  for (int i = 0; i < Size; ++i) {
    all = all && found.state(i) == expected.state(i);
    for (int k = 0; k < Size; ++k) {
      all = all && found.covariance(i, k) == expected.covariance(i, k);
    }
  }
  return all ? Verdict::proved : Verdict::undecided;
}

/// Does an estimate omega = 0 that shares no covariance with x and its derivative stay one?
Verdict stays_at_zero() {
  Estimate<3> start = any_estimate<3>();
  start.state(2) = Symbol();
  for (int i = 0; i < 2; ++i) {
    start.covariance(i, 2) = start.covariance(2, i) = Symbol();
  }
  trackers::OscillatorEkf<Symbol> filter(any_filter(), start);
  filter.step(Symbol::symbol("y"));
  const Estimate<3> found = filter.filtered();
  return found.state(2).is_zero() && found.covariance(0, 2).is_zero() && found.covariance(1, 2).is_zero()
             ? Verdict::proved
             : Verdict::undecided;
}

const std::string kSame =
    "One step of the program on symbols, with the signs outside, is the same expression; so are "
    "all steps, by induction. ";

Statement symmetry(const std::string& id, const std::string& sentence, Verdict verdict,
                   const std::string& more = {}) {
  return make_statement("zarchan/symmetry/" + id, sentence, verdict, kSame + more, {});
}

std::vector<Statement> symmetries() {
  using Oscillator = trackers::OscillatorEkf<Symbol>;
  using Square = trackers::SquaredFrequencyEkf<Symbol>;
  using Phase = trackers::SinePhaseEkf<Symbol>;
  using Known = trackers::SineKnownAmplitudeEkf<Symbol>;
  return {symmetry("oscillator-sign",
                   "The filter of (x, x', omega) estimates the magnitude of the frequency and not its sign: "
                   "started at "
                   "-omega in place of omega it gives the same x and x' and the frequency of the other sign, "
                   "for every "
                   "measurement.",
                   commutes<Oscillator, 3>({{false, false, true}})),
          symmetry("oscillator-zero",
                   "Started at omega = 0 the filter of (x, x', omega) estimates omega = 0 for ever.",
                   stays_at_zero(), "P(0) diagonal, as in the slides."),
          symmetry("oscillator-measurement",
                   "The filter of (x, x', omega) with -y gives -x, -x' and the same omega.",
                   commutes<Oscillator, 3>({{true, true, false}, false, true})),
          symmetry("square-measurement", "The filter of (x, x', z) with -y gives -x, -x' and the same z.",
                   commutes<Square, 3>({{true, true, false}, false, true})),
          symmetry("phase-mirrored",
                   "The filter of (phi, omega, A) at (-phi, -omega, -A) does the same, mirrored: no "
                   "measurement distinguishes them.",
                   commutes<Phase, 3>({{true, true, true}})),
          symmetry("phase-half-turn", "The filter of (phi, omega, A) at (phi + pi, omega, -A) does the same.",
                   commutes<Phase, 3>({{false, false, true}, true})),
          symmetry("known-amplitude-mirrored",
                   "The filter of (phi, omega) at (pi - phi, -omega) does the same, mirrored: it is the "
                   "start at phi = 0 "
                   "that makes the sign of omega matter.",
                   commutes<Known, 2>({{true, true}, true}))};
}

Statement never_settles(const std::string& filter, const std::string& words, Verdict verdict,
                        const std::string& ground) {
  return make_statement(
      "zarchan/steady-state/" + filter,
      "Without process noise, as the slides run it, the filter of " + words +
          " has no steady state: a covariance that a step leaves as it is has no variance of the "
          "frequency, with which no measurement would change its estimate.",
      verdict, ground, {});
}

std::vector<Statement> steady_states() {
  // The variance of the frequency falls by g^2/s, g its covariance with the prediction of y; multiplied by s.
  const Verdict falls = rigor::vanishes<3>(
      [](const std::array<Interval, 3>& at) {
        const auto& [variance, g, s] = at;
        return variance * s - (variance * s - square(g)) - square(g);
      },
      2);
  const std::string first =
      "An update takes g^2/s from the variance of omega, g its covariance with what is predicted of y: a "
      "steady state "
      "has g = 0, and then leaves P12 = P12 + TS P22, so that P22 = 0.";
  const std::string second =
      "P33 stays only if M13 = 0; then P13 = 0, M13 = P13 + TS P23 gives P23 = 0, and M23 = P23 = c TS P33 "
      "gives P33 = 0 "
      "where the coupling c is not 0 (x other than 0";
  return {never_settles("phase", "(phi, omega, A)", falls, first),
          never_settles("known-amplitude", "(phi, omega)", falls, first),
          never_settles("oscillator", "(x, x', omega), where x and omega are not 0,", falls,
                        second + ", omega too)."),
          never_settles("square", "(x, x', z), where x is not 0,", falls, second + ").")};
}

/// Is the frequency found to within this, for every noise of that size?
Statement found_in_time(const std::string& id, const HorizonQuestion& question, const char* within) {
  const Interval found = frequency_after(question);
  const Interval error = abs(found - rigor::parse_decimal(question.frequency));
  return make_statement(
      "zarchan/horizon/" + id,
      "The filter of (phi, omega), which assumes a noise of 0.1, finds omega = " + question.frequency +
          " from the estimate " + question.first_frequency + " for every noise of at most " + question.noise +
          ": after 20 s it is within " + within + " rad/s.",
      decide(error, rigor::parse_decimal(within), Strictness::weak),
      "Verified simulation of states and covariance together: the estimate is in " + enclosed(found) +
          " rad/s.",
      {});
}

}  // namespace

std::vector<Statement> sine_filter_claims() {
  std::vector<Statement> statements = symmetries();
  for (Statement& statement : steady_states()) {
    statements.push_back(std::move(statement));
  }
  statements.push_back(found_in_time("positive", {"1", "2", "1e-4", "0.01"}, "0.0002"));
  statements.push_back(found_in_time("negative", {"-1", "2", "1e-5", "0.01"}, "0.00002"));
  return statements;
}

}  // namespace veritrack::theorems
