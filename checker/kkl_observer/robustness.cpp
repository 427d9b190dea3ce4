#include "checker/kkl_observer/robustness.hpp"

#include <functional>

#include "checker/document/evidence.hpp"
#include "checker/kkl_observer/filter_deviation.hpp"
#include "checker/kkl_observer/projected_cells.hpp"
#include "checker/kkl_observer/rounded_map.hpp"
#include "checker/kkl_observer/signal_cells.hpp"

namespace veritrack::checker {

namespace {

/// The end of an enclosure that carries its meaning; a ball of everything when there is no enclosure.
Ball end_of(const Tree* enclosure, const char* end) {
  return enclosure != nullptr ? exact_number(enclosure->at(end)) : Ball::everything();
}

const Tree* left_side(const Tree& derivation, std::string_view id) {
  for (const Tree& condition : derivation.at("conditions").elements()) {
    if (condition.at("id").text() == id) {
      return condition.find("lhs");
    }
  }
  return nullptr;
}

/// Bounds that the estimates have in exact arithmetic.
struct ExactBounds {
  Ball largest_ell, relative_square, frequency_error, amplitude_error;
};

/// The contribution of double precision to the errors of such estimates: rad/s, signal units.
MapRounding rounding_of(const KklDesign& design, const Ball& settling_time, const Ball& ell,
                        const ExactBounds& exact) {
  static const Ball kSmallest(0x1p-240);
  static const Ball kLargest(0x1p240);
  const Moves moves(design, settling_time);
  FilterStates states{design.lambda, ell, exact.largest_ell, {}, {}, {}};
  // |xi| / A, and its smallest value: some filter is outside of the neighbourhood of zero.
  Ball squares(0.0);
  Ball fastest(0.0);
  for (std::size_t i = 0; i < states.lambda.size(); ++i) {
    const Ball gain = one / sqrt(square(states.lambda[i]) + square(design.frequency_low));
    squares += square(moves.reach(i, gain));
    fastest = max(fastest, states.lambda[i]);
  }
  const Ball longest = sqrt(squares).upper();
  const bool in_range = certainly_at_most(kSmallest, design.amplitude_low * neighbourhood / fastest) &&
                        certainly_at_most(design.amplitude_high * longest, kLargest);
  if (!in_range) {
    return {Ball::everything(), Ball::everything()};
  }
  states.least_square = (exact.relative_square * square(design.frequency_low)).lower();
  states.most_square = square(design.frequency_high + exact.frequency_error).upper();
  states.least_amplitude = (design.amplitude_low - exact.amplitude_error) / (design.amplitude_low * longest);
  const MapRounding rounding = map_rounding(states);
  return {rounding.frequency, rounding.amplitude * design.amplitude_high * longest};
}

/// Is a number a bound of all signals? In exact arithmetic; the last one given a bound on the frequency
/// error.
struct Statements {
  std::function<bool(const Ball&bound)> ratio_at_least, relative_square_at_least, frequency_error_at_most;
  std::function<bool(const Ball& bound, const Ball& frequency_error)> amplitude_error_at_most;
};

Statements of_four_filters(const KklDesign& design, const Ball& settling_time) {
  const SignalCells cells(design, settling_time);
  const auto of_all = [cells](auto statement) {
    return [cells, statement](const Ball& bound) {
      return cells.always([&](const KklCell& cell) { return (cells.*statement)(cell, bound); });
    };
  };
  const auto amplitude = of_all(&SignalCells::amplitude_error_at_most);
  return {of_all(&SignalCells::ratio_at_least), of_all(&SignalCells::relative_square_at_least),
          of_all(&SignalCells::frequency_error_at_most),
          [amplitude](const Ball& bound, const Ball& /*frequency_error*/) { return amplitude(bound); }};
}

Statements of_more_filters(const KklDesign& design, const Ball& settling_time) {
  const ProjectedCells cells(design, settling_time);
  const auto of_all = [cells](auto statement) {
    return [cells, statement](const Ball& bound) {
      return cells.always([&](const ProjectedCell& cell) { return (cells.*statement)(cell, bound); });
    };
  };
  return {of_all(&ProjectedCells::ratio_at_least), of_all(&ProjectedCells::relative_square_at_least),
          of_all(&ProjectedCells::frequency_error_at_most),
          [cells](const Ball& bound, const Ball& frequency_error) {
            return cells.always([&](const ProjectedCell& cell) {
              return cells.amplitude_error_at_most(cell, bound, frequency_error);
            });
          }};
}

}  // namespace

void check_kkl_robustness(const Tree& claimed, const KklDesign& design, const Ball& ell,
                          Objections& objections) {
  constexpr std::size_t kFour = 4;
  const Tree& quantities = claimed.at("quantities");
  const Ball settling_time = end_of(quantities.find("settling_time"), "hi");
  const Statements are = design.lambda.size() == kFour ? of_four_filters(design, settling_time)
                                                       : of_more_filters(design, settling_time);
  // A bound that all signals have, or nothing.
  const auto established = [](const Ball& bound, const std::function<bool(const Ball&)>& statement) {
    return bound.finite() && statement(bound) ? bound : Ball::everything();
  };
  const Ball largest_ell = established(end_of(quantities.find("largest_ell"), "lo"), are.ratio_at_least);
  const Ball relative_square =
      established(end_of(left_side(claimed, "frequency-exists"), "lo"), are.relative_square_at_least);
  // Where mu of (9) may not vanish the estimates are different.
  const Verdict regular = proved_if(certainly_at_most(ell, largest_ell));
  const Verdict exists = all_of({regular, proved_if(certainly_positive(relative_square))});
  // The exact errors must be within the claimed bounds minus the contribution of rounding, which assumes no
  // more than the claimed bounds.
  const ExactBounds claim{largest_ell, relative_square,
                          end_of(quantities.find("frequency_error_bound"), "hi"),
                          end_of(quantities.find("amplitude_error_bound"), "hi")};
  Ball frequency = Ball::everything();
  Ball amplitude = Ball::everything();
  if (exists == Verdict::proved) {
    const MapRounding rounding = rounding_of(design, settling_time, ell, claim);
    const Ball exact_frequency = (claim.frequency_error - rounding.frequency).lower();
    const Ball exact_amplitude = (claim.amplitude_error - rounding.amplitude).lower();
    if (established(exact_frequency, are.frequency_error_at_most).finite()) {
      frequency = claim.frequency_error;
      const auto with_frequency = [&](const Ball& bound) {
        return are.amplitude_error_at_most(bound, exact_frequency);
      };
      amplitude =
          established(exact_amplitude, with_frequency).finite() ? claim.amplitude_error : Ball::everything();
    }
  }
  const bool bounded = frequency.finite() && amplitude.finite();
  check_derivation(
      claimed,
      {"Bounds on the estimation errors under the assumed disturbance",
       {{"frequency_error_bound", frequency, Sense::bounds_above},
        {"amplitude_error_bound", amplitude, Sense::bounds_above},
        {"settling_time", settling_time, Sense::bounds_above},
        {"largest_ell", largest_ell, Sense::bounds_below}},
       {{"regular", R"(\ell \le 2 \inf |M\xi|^2 / |\xi|^2)", regular, ell, largest_ell},
        {"frequency-exists", R"(\hat x_3 / x_3 > 0)", exists, relative_square, zero, Sense::bounds_below},
        {"bounded", R"(|\hat\omega - \omega| \le b_\omega,\ |\hat A - A| \le b_A)", proved_if(bounded),
         frequency}}},
      objections);
}

}  // namespace veritrack::checker
