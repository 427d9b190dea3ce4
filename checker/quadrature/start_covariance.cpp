#include "checker/quadrature/start_covariance.hpp"

#include <array>

#include "checker/document/evidence.hpp"
#include "checker/quadrature/certified_set.hpp"

namespace veritrack::checker {

namespace {

using Texts = std::array<std::array<std::string, 3>, 3>;

std::string words_of(const Texts& m) {
  std::string text = "[";
  for (std::size_t i = 0; i < 3; ++i) {
    text += i == 0 ? "" : "; ";
    for (std::size_t j = 0; j < 3; ++j) {
      text += (j == 0 ? "" : ", ") + m[i][j];
    }
  }
  return text + "] in the frame of the estimated phase";
}

/// The decimals of the matrix, in signal units.
Matrix3 matrix_of(const Texts& texts, const Ball& amplitude) {
  const std::array<Ball, 3> unit{amplitude, amplitude, one};
  Matrix3 m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      m[i][j] = from_decimal(texts[i][j]) / (unit[i] * unit[j]);
    }
  }
  return m;
}

}  // namespace

bool StartCovariance::between(const Covariance<Ball>& lower, const Covariance<Ball>& upper) const {
  return definite(scaled(from, matrix) - whole(lower)) && definite(whole(upper) - scaled(to, matrix));
}

Matrix3 StartCovariance::enclosure() const {
  Matrix3 p = scaled(from, matrix);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      p[i][j] += Ball::within((to - from) * sqrt(matrix[i][i] * matrix[j][j]));
    }
  }
  return p;
}

std::optional<StartCovariance> read_start_covariance(const Tree& derivation, const Design& design,
                                                     Objections& objections) {
  if (design.covariance) {
    return StartCovariance{*design.covariance, one, one,
                           "and with P(0|0) = " + words_of(design.covariance_texts)};
  }
  const Tree* evidence = find_evidence(derivation, "start-covariance");
  if (evidence == nullptr) {
    return std::nullopt;
  }
  const Tree& decimals = evidence->at("decimals");
  const auto text = [&](const char* name) { return decimals.at(name).text(); };
  const Texts texts{{{text("p11"), text("p12"), text("p13")},
                     {text("p12"), text("p22"), text("p23")},
                     {text("p13"), text("p23"), text("p33")}}};
  StartCovariance start{
      matrix_of(texts, design.amplitude), from_decimal(text("from")), from_decimal(text("to")),
      "and with P(0|0) from " + text("from") + " M to " + text("to") + " M, M = " + words_of(texts)};
  if (!definite(start.matrix) || !certainly_positive(start.from) || !certainly_at_most(start.from, one) ||
      !certainly_at_most(one, start.to)) {
    objections.emplace_back(
        "the start covariance is not positive definite, or its multiples do not contain 1");
    return std::nullopt;
  }
  return start;
}

}  // namespace veritrack::checker
