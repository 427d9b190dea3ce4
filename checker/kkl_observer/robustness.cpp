#include "checker/kkl_observer/robustness.hpp"

#include "checker/document/evidence.hpp"
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

}  // namespace

void check_kkl_robustness(const Tree& claimed, const KklDesign& design, const Ball& ell,
                          Objections& objections) {
  if (!design.has_four_filters()) {
    objections.emplace_back("the bounds are defined for four filters");
    return;
  }
  const Tree& quantities = claimed.at("quantities");
  const Ball settling_time = end_of(quantities.find("settling_time"), "hi");
  const SignalCells cells(design, settling_time);
  // A bound that all cells have, or nothing.
  const auto established = [&](const Ball& bound, auto statement) {
    const bool is_proved =
        bound.finite() && cells.always([&](const KklCell& cell) { return (cells.*statement)(cell, bound); });
    return is_proved ? bound : Ball::everything();
  };
  const Ball largest_ell =
      established(end_of(quantities.find("largest_ell"), "lo"), &SignalCells::ratio_at_least);
  const Ball relative_square = established(end_of(left_side(claimed, "frequency-exists"), "lo"),
                                           &SignalCells::relative_square_at_least);
  // Where mu of (9) may not vanish the estimates are others.
  const Verdict regular = proved_if(certainly_at_most(ell, largest_ell));
  const Verdict exists = all_of({regular, proved_if(certainly_positive(relative_square))});
  const auto of_estimate = [&](const Ball& bound, auto statement) {
    return exists == Verdict::proved ? established(bound, statement) : Ball::everything();
  };
  const Ball frequency = of_estimate(end_of(quantities.find("frequency_error_bound"), "hi"),
                                     &SignalCells::frequency_error_at_most);
  const Ball amplitude = of_estimate(end_of(quantities.find("amplitude_error_bound"), "hi"),
                                     &SignalCells::amplitude_error_at_most);
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
