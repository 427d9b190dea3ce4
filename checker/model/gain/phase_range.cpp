#include "checker/model/gain/phase_range.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "checker/model/gain/wide_number.hpp"
#include "checker/model/place_powers.hpp"

namespace veritrack::checker {

namespace {

constexpr int kPiecesOfCell = 8;
constexpr std::size_t kPowersOfPlace = BallPolynomial::kMostDegree + 1;

/// By the power of z, then that of s.
using PlaceTable = std::array<std::array<double, kPowersOfPlace>, kPowersOfPlace>;

/// A polynomial in s within `half` of `middle`: near its value there, and how far it goes from that.
struct PieceValue {
  double middle = 0.0, distance = 0.0;
};

PieceValue over_piece(std::array<double, kPowersOfPlace> coefficients, double middle, double half) {
  // Taylor's coefficients there, by repeated division.
  for (std::size_t first = 0; first + 1 < kPowersOfPlace; ++first) {
    for (std::size_t k = kPowersOfPlace - 1; k-- > first;) {
      coefficients[k] += middle * coefficients[k + 1];
    }
  }
  PieceValue result{coefficients[0], 0.0};
  double power = half;
  for (std::size_t k = 1; k < kPowersOfPlace; ++k) {
    result.distance += std::abs(coefficients[k]) * power;
    power *= half;
  }
  return result;
}

}  // namespace

DoubleRange range_over_cell(const BallPolynomial& x) {
  if (!x.known() || x.vector_degree() > 0) {
    return {-HUGE_VAL, HUGE_VAL};
  }
  PlaceTable by_powers{};
  const std::span<const double> places = x.block(0, 0);
  double size = 0.0;
  for (std::size_t place = 0; place < places.size(); ++place) {
    const Powers powers = powers_at(place);
    by_powers[static_cast<std::size_t>(powers.of_z)][static_cast<std::size_t>(powers.of_s)] = places[place];
    size += std::abs(places[place]);
  }
  const double error = up(x.error() + upward_product(0x1p-44, size));
  DoubleRange range{HUGE_VAL, -HUGE_VAL};
  for (int piece = 0; piece < kPiecesOfCell; ++piece) {
    const double middle = (2.0 * piece + 1.0) / kPiecesOfCell - 1.0;
    const PieceValue value = over_piece(by_powers[0], middle, 1.0 / kPiecesOfCell);
    double distance = value.distance + error;
    for (std::size_t of_z = 1; of_z < kPowersOfPlace; ++of_z) {
      const PieceValue more = over_piece(by_powers[of_z], middle, 1.0 / kPiecesOfCell);
      distance += std::abs(more.middle) + more.distance;
    }
    distance = up(distance);
    range.low = std::min(range.low, value.middle - distance);
    range.high = std::max(range.high, value.middle + distance);
  }
  // The ends are rounded once more.
  const double rounding = 0x1p-50;
  range.low -= rounding * std::abs(range.low);
  range.high += rounding * std::abs(range.high);
  const bool is_finite = std::isfinite(range.low) && std::isfinite(range.high);
  return is_finite ? range : DoubleRange{-HUGE_VAL, HUGE_VAL};
}

double largest_in(const DoubleRange& range) {
  const double most = std::max(-range.low, range.high);
  return std::isfinite(range.low) && std::isfinite(range.high) ? std::max(most, 0.0) : HUGE_VAL;
}

}  // namespace veritrack::checker
