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
  return text + "]";
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

constexpr const char* kFrame = " in the frame of the estimated phase";

/// The multiples contain M itself, or are those that the design asks for.
bool are_sound(const std::string& from, const std::string& to, const Design& design) {
  if (design.covariance_multiples) {
    return from == design.multiples_texts[0] && to == design.multiples_texts[1];
  }
  return certainly_positive(from_decimal(from)) && certainly_at_most(from_decimal(from), one) &&
         certainly_at_most(one, from_decimal(to));
}

}  // namespace

bool StartCovariance::between(const Covariance<Ball>& lower, const Covariance<Ball>& upper) const {
  return definite(lowest - whole(lower)) && definite(whole(upper) - highest);
}

Matrix3 StartCovariance::enclosure() const {
  const Matrix3 spread = highest - lowest;
  Matrix3 p = lowest;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      p[i][j] += Ball::within(root_of_non_negative(spread[i][i] * spread[j][j]));
    }
  }
  return p;
}

std::optional<StartCovariance> read_start_covariance(const Tree& derivation, const Design& design,
                                                     Objections& objections) {
  if (design.covariance) {
    const std::string lowest = words_of(design.covariance_texts);
    if (design.highest_covariance) {
      return StartCovariance{*design.covariance, *design.highest_covariance,
                             "and with every P(0|0) from " + lowest + " to " +
                                 words_of(design.highest_covariance_texts) + kFrame};
    }
    return StartCovariance{*design.covariance, *design.covariance, "and with P(0|0) = " + lowest + kFrame};
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
  const Matrix3 matrix = matrix_of(texts, design.amplitude);
  if (!definite(matrix) || !are_sound(text("from"), text("to"), design)) {
    objections.emplace_back(
        "the start covariance is not positive definite, or its multiples do not contain 1 or are not those "
        "of the design");
    return std::nullopt;
  }
  const auto& asked = design.covariance_multiples;
  return StartCovariance{scaled(asked ? (*asked)[0] : from_decimal(text("from")), matrix),
                         scaled(asked ? (*asked)[1] : from_decimal(text("to")), matrix),
                         std::string(asked ? "and with every" : "and with") + " P(0|0) from " + text("from") +
                             " M to " + text("to") + " M, M = " + words_of(texts) + kFrame};
}

}  // namespace veritrack::checker
