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
Multiples multiples_text(const StartCovarianceText& text, const std::optional<Interval>& multiples) {
  if (text.multiples) {
    return {(*text.multiples)[0], (*text.multiples)[1]};
  }
  if (!multiples) {
    return {"0.999999", "1.000001"};
  }
  constexpr int kDigits = 3;
  const std::string from = rigor::to_decimal(multiples->lower(), kDigits, rigor::Direction::up);
  const std::string to = rigor::to_decimal(multiples->upper(), kDigits, rigor::Direction::down);
  // Where the multiples reach less than the digits show, the smallest margin is printed.
  return {multiples->lower() < 0.99 ? from : "0.999999", multiples->upper() > 1.01 ? to : "1.000001"};
}

StartCovarianceText::Entries texts_of(const CovarianceArray& array) {
  StartCovarianceText::Entries texts;
  for (std::size_t i = 0; i < array.size(); ++i) {
    for (std::size_t j = 0; j < array.size(); ++j) {
      texts[i][j] = array[i][j].text;
    }
  }
  return texts;
}

std::string matrix_words(const StartCovarianceText::Entries& m) {
  std::string words = "[";
  for (std::size_t i = 0; i < m.size(); ++i) {
    words += fmt::format("{}{}, {}, {}", i == 0 ? "" : "; ", m[i][0], m[i][1], m[i][2]);
  }
  return words + "]";
}

}  // namespace

StartCovarianceText start_covariance_text(const QuadratureEkfTables& tables) {
  StartCovarianceText text;
  if (const auto& given = tables.assume.initial_covariance) {
    text.is_given = true;
    text.entries = texts_of(*given);
    return text;
  }
  if (const auto& range = tables.assume.covariance_range) {
    text.is_given = true;
    text.entries = texts_of((*range)[0]);
    text.highest = texts_of((*range)[1]);
    return text;
  }
  if (const auto& multiples = tables.assume.covariance_multiples) {
    text.multiples = {(*multiples)[0].text, (*multiples)[1].text};
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
  const Interval& amplitude = tables.assume.amplitude.value;
  const auto matrix_of = [&](const StartCovarianceText::Entries& entries) {
    const std::array<Interval, 3> unit{amplitude, amplitude, Interval(1.0)};
    rigor::IntervalMatrix<3> matrix;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            rigor::parse_decimal(entries[i][j]) / (unit[i] * unit[j]);
      }
    }
    return matrix;
  };
  start.is_given = text.is_given || text.multiples;
  start.matrix = matrix_of(text.entries);
  if (text.highest) {
    start.highest = matrix_of(*text.highest);
  }
  if (text.highest || text.multiples) {
    // As in the sentence, without its conjunction.
    const std::string words = covariance_words(text, std::nullopt);
    start.range = words.substr(words.find("every"));
  }
  if (const auto& multiples = tables.assume.covariance_multiples) {
    start.multiples = rigor::hull((*multiples)[0].value, (*multiples)[1].value);
  } else if (!start.is_given) {
    start.multiples = Interval::from_bounds(1.0 - kLeastMargin, 1.0 + kLeastMargin);
  }
  return start;
}

std::string covariance_words(const StartCovarianceText& text, const std::optional<Interval>& multiples) {
  const std::string matrix = matrix_words(text.entries);
  constexpr const char* kFrame = "in the frame of the estimated phase";
  if (text.highest) {
    return fmt::format("and with every P(0|0) from {} to {} {}", matrix, matrix_words(*text.highest), kFrame);
  }
  if (text.is_given) {
    return fmt::format("and with P(0|0) = {} {}", matrix, kFrame);
  }
  const auto [from, to] = multiples_text(text, multiples);
  return fmt::format("and with {}P(0|0) from {} M to {} M, M = {} {}", text.multiples ? "every " : "", from,
                     to, matrix, kFrame);
}

void add_start_covariance(const StartCovarianceText& text, const std::optional<Interval>& multiples,
                          theorems::Derivation& derivation) {
  if (text.is_given) {
    return;
  }
  const auto& m = text.entries;
  const auto [from, to] = multiples_text(text, multiples);
  theorems::Evidence evidence{"start-covariance", {}, {}, {}};
  evidence.decimals = {{"p11", m[0][0]}, {"p12", m[0][1]}, {"p13", m[0][2]}, {"p22", m[1][1]},
                       {"p23", m[1][2]}, {"p33", m[2][2]}, {"from", from},   {"to", to}};
  derivation.evidence.push_back(std::move(evidence));
}

}  // namespace veritrack::certificates
