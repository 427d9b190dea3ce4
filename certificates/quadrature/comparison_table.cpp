#include "certificates/quadrature/comparison_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/rigor/decimal.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "certificates/quadrature/simulated_limits.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Direction;
using rigor::Interval;

/// The value, when it applies and is above zero.
std::optional<Interval> above_zero(const theorems::Quantity* quantity) {
  const bool compares =
      quantity != nullptr && quantity->applies() && rigor::certainly_positive(quantity->value);
  return compares ? std::optional(quantity->value) : std::nullopt;
}

/// A published result: those that certify a start, a noise or a rate use the same names for them.
ComparedResult row_of(const theorems::Derivation& derivation) {
  const auto value_of = [&](const char* name) {
    return above_zero(theorems::applicable_quantity(derivation, name));
  };
  return {derivation.id, derivation.verdict, value_of("initial_frequency_error_bound"),
          value_of("noise_bound"), value_of("rate")};
}

ComparedResult row_of(const theorems::Derivation& derivation, const sets::KalmanFilterResult& result) {
  return {derivation.id, derivation.verdict, above_zero(&result.frequency_error_radius),
          above_zero(&result.largest_noise), above_zero(&result.contraction_rate)};
}

std::string bound_text(const ComparedResult& row, const std::optional<Interval>& value, Direction direction) {
  if (!value) {
    return "none";
  }
  if (row.simulated) {
    return fmt::format("≈ {:.3g}", rigor::midpoint(*value));
  }
  if (direction == Direction::down) {
    return rigor::lower_decimal(*value);
  }
  const std::string rounded = rigor::upper_decimal(*value);
  return value->upper() < 1.0 && rounded == "1" ? "< 1" : "≤ " + rounded;
}

}  // namespace

void add_comparison(Certificate& certificate) {
  for (const theorems::Derivation& derivation : certificate.derivations) {
    const bool is_contraction = derivation.id == "contraction";
    ComparedResult row = is_contraction ? row_of(derivation, *certificate.contraction) : row_of(derivation);
    const bool always_shown = is_contraction || derivation.id.starts_with("theorem-2.9/");
    if (always_shown || row.frequency_error || row.noise || row.rate) {
      quadrature_particulars(certificate).comparison.push_back(std::move(row));
    }
  }
  const SimulatedLimits limits = find_simulated_limits(certificate.design);
  quadrature_particulars(certificate)
      .comparison.push_back({"simulation", std::nullopt, Interval(limits.frequency_error),
                             Interval(limits.noise), Interval(limits.rate), true});
}

std::string comparison_section(const Certificate& certificate, ComparedResults which) {
  if (quadrature_particulars(certificate).comparison.empty()) {
    return "";
  }
  std::vector<std::vector<std::string>> rows;
  rows.reserve(quadrature_particulars(certificate).comparison.size());
  for (const ComparedResult& row : quadrature_particulars(certificate).comparison) {
    const bool belongs =
        row.simulated || row.result == "contraction" || row.result.starts_with("theorem-2.9/");
    if (which == ComparedResults::of_the_theorem && !belongs) {
      continue;
    }
    rows.push_back({row.simulated ? "*simulation, no proof*" : "`" + row.result + "`",
                    bound_text(row, row.frequency_error, Direction::down),
                    bound_text(row, row.noise, Direction::down), bound_text(row, row.rate, Direction::up),
                    row.verdict ? markdown::satisfied(*row.verdict) : "—"});
  }
  std::string text = which == ComparedResults::all ? "## What each result certifies, side by side\n\n"
                                                   : "## How it compares\n\n";
  text += markdown::table({"Result", "Largest start error of the frequency, rad/sample",
                           "Largest noise, relative to the amplitude", "Rate per sample",
                           "Conditions for the assumed start and noise"},
                          rows);
  if (which == ComparedResults::of_the_theorem) {
    return text +
           "\n*contraction* is this certificate. The simulation is for one frequency, exact phase and "
           "amplitude, and a few noise patterns. Theorem 2.9 is the published theorem for this filter: "
           "[published-theorems.md](published-theorems.md) has its constants and all other results, and says "
           "what the columns mean.\n\n";
  }
  return text +
         "\nThe table gives the largest certified start error and the largest certified noise; \"none\" "
         "means that the result certifies none for this design. Where a result has both, start errors assume "
         "no noise; noise limits assume an exact start. The last column concerns this design's [assume]: a "
         "result may certify a start error or a noise and still not cover the assumed ones. With a leak, the "
         "certified start and noise are for a signal that leaks as in the model; a constant frequency is "
         "modelled as process noise. For contraction the start error is the largest in the certified set. "
         "The simulation is for one frequency, exact phase and amplitude, and a few noise patterns.\n\n";
}

}  // namespace veritrack::certificates
