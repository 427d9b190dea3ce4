#include "certificates/quadrature/start_covariance.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/quadrature/start_covariance.hpp"
#include "analysis/rigor/decimal.hpp"
#include "certificates/quadrature/guarantee.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;

/// The matrix in the documents and the one in a program's memory differ by their rounding: both are covered.
constexpr double kLeastMargin = 1e-6;

struct Multiples {
  std::string from, to;
};
Multiples multiples_text(const std::optional<Interval>& multiples) {
  if (!multiples) {
    return {"0.999999", "1.000001"};
  }
  constexpr int kDigits = 3;
  const std::string from = rigor::to_decimal(multiples->lower(), kDigits, rigor::Direction::up);
  const std::string to = rigor::to_decimal(multiples->upper(), kDigits, rigor::Direction::down);
  // Where the multiples reach less than the digits show, the least margin is what is said.
  return {multiples->lower() < 0.99 ? from : "0.999999", multiples->upper() > 1.01 ? to : "1.000001"};
}

}  // namespace

StartCovarianceText start_covariance_text(const QuadratureEkfTables& tables) {
  StartCovarianceText text;
  if (const auto& given = tables.assume.initial_covariance) {
    text.is_given = true;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        text.entries[i][j] = (*given)[i][j].text;
      }
    }
    return text;
  }
  const double amplitude = tables.assume.amplitude.nearest;
  const double middle = 0.5 * (tables.assume.frequency[0].nearest + tables.assume.frequency[1].nearest);
  const rigor::Matrix<3> p = quadrature::near_steady_covariance(nearest_at_unit_amplitude(tables), middle);
  const std::array<double, 3> unit{amplitude, amplitude, 1.0};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double entry =
          p(static_cast<Eigen::Index>(std::min(i, j)), static_cast<Eigen::Index>(std::max(i, j)));
      text.entries[i][j] = entry == 0.0 ? "0" : fmt::format("{:.5g}", entry * unit[i] * unit[j]);
    }
  }
  return text;
}

sets::StartCovariance start_covariance(const QuadratureEkfTables& tables) {
  StartCovarianceText text;
  {
    const rigor::NearestRounding nearest;
    text = start_covariance_text(tables);
  }
  sets::StartCovariance start;
  start.is_given = text.is_given;
  const Interval& amplitude = tables.assume.amplitude.value;
  const std::array<Interval, 3> unit{amplitude, amplitude, Interval(1.0)};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      start.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          rigor::parse_decimal(text.entries[i][j]) / (unit[i] * unit[j]);
    }
  }
  if (!start.is_given) {
    start.multiples = Interval::from_bounds(1.0 - kLeastMargin, 1.0 + kLeastMargin);
  }
  return start;
}

std::string covariance_words(const StartCovarianceText& text, const std::optional<Interval>& multiples) {
  const auto& m = text.entries;
  std::string matrix = "[";
  for (std::size_t i = 0; i < m.size(); ++i) {
    matrix += fmt::format("{}{}, {}, {}", i == 0 ? "" : "; ", m[i][0], m[i][1], m[i][2]);
  }
  matrix += "] in the frame of the estimated phase";
  if (text.is_given) {
    return "and with P(0|0) = " + matrix;
  }
  const auto [from, to] = multiples_text(multiples);
  return fmt::format("and with P(0|0) from {} M to {} M, M = {}", from, to, matrix);
}

void add_start_covariance(const StartCovarianceText& text, const std::optional<Interval>& multiples,
                          theorems::Derivation& derivation) {
  if (text.is_given) {
    return;
  }
  const auto& m = text.entries;
  const auto [from, to] = multiples_text(multiples);
  theorems::Evidence evidence{"start-covariance", {}, {}, {}};
  evidence.decimals = {{"p11", m[0][0]}, {"p12", m[0][1]}, {"p13", m[0][2]}, {"p22", m[1][1]},
                       {"p23", m[1][2]}, {"p33", m[2][2]}, {"from", from},   {"to", to}};
  derivation.evidence.push_back(std::move(evidence));
}

}  // namespace veritrack::certificates
