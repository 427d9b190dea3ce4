#include "certificates/quadrature/comparison_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "analysis/rigor/decimal.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "certificates/quadrature/simulated_limits.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Direction;
using rigor::Interval;

/// The first of these quantities that the derivation has, above zero.
std::optional<Interval> value_of(const theorems::Derivation& derivation,
                                 std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    const theorems::Quantity* quantity = theorems::applicable_quantity(derivation, name);
    if (quantity != nullptr && rigor::certainly_positive(quantity->value)) {
      return quantity->value;
    }
  }
  return std::nullopt;
}

std::string bound_text(const ComparedResult& row, const std::optional<Interval>& value, Direction direction) {
  if (!value) {
    return "none";
  }
  if (row.simulated) {
    return fmt::format("≈ {:.3g}", rigor::midpoint(*value));
  }
  if (direction == Direction::down) {
    return rigor::to_decimal(value->lower(), 4, direction);
  }
  const std::string rounded = rigor::to_decimal(value->upper(), 4, direction);
  return value->upper() < 1.0 && rounded == "1" ? "< 1" : "≤ " + rounded;
}

}  // namespace

void add_comparison(Certificate& certificate) {
  for (const theorems::Derivation& derivation : certificate.derivations) {
    ComparedResult row;
    row.result = derivation.id;
    row.verdict = derivation.verdict;
    row.frequency_error = value_of(derivation, {"initial_frequency_error_bound", "frequency_error_radius"});
    row.noise = value_of(derivation, {"noise_bound", "largest_noise"});
    row.rate = value_of(derivation, {"rate", "contraction_rate"});
    const bool always_shown =
        derivation.id.starts_with("theorem-2.9/") || derivation.id.starts_with("contraction");
    if (always_shown || row.frequency_error || row.noise || row.rate) {
      quadrature_particulars(certificate).comparison.push_back(std::move(row));
    }
  }
  const SimulatedLimits limits = find_simulated_limits(certificate.design);
  quadrature_particulars(certificate)
      .comparison.push_back({"simulation", std::nullopt, Interval(limits.frequency_error),
                             Interval(limits.noise), Interval(limits.rate), true});
}

std::string comparison_section(const Certificate& certificate) {
  if (quadrature_particulars(certificate).comparison.empty()) {
    return "";
  }
  std::vector<std::vector<std::string>> rows;
  rows.reserve(quadrature_particulars(certificate).comparison.size());
  for (const ComparedResult& row : quadrature_particulars(certificate).comparison) {
    rows.push_back({row.simulated ? "*simulation, no proof*" : "`" + row.result + "`",
                    bound_text(row, row.frequency_error, Direction::down),
                    bound_text(row, row.noise, Direction::down), bound_text(row, row.rate, Direction::up),
                    row.verdict ? markdown::verdict(*row.verdict) : "—"});
  }
  std::string text = "## What each result certifies, side by side\n\n";
  text += markdown::table(
      {"Result", "Start error of the frequency, up to, rad/sample", "Noise, up to, relative to the amplitude",
       "Rate per sample", "Conditions for the assumed start and noise"},
      rows);
  return text +
         "\nA start error or a noise up to the value given is certified, the start without noise and the "
         "noise from an exact start where a result has both; \"none\" means that the result certifies none "
         "for this design. The last column is about this design's [assume]: a result may certify something "
         "and still not reach the assumed start or noise. Where the frequency state leaks the certified "
         "start and noise are for a signal that leaks as the model says; a constant frequency then counts as "
         "process noise. For contraction the start error is the largest in the certified set. The simulation "
         "is one frequency, exact phase and amplitude, and a few noise patterns.\n\n";
}

}  // namespace veritrack::certificates
