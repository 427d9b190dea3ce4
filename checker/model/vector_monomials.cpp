#include "checker/model/vector_monomials.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace veritrack::checker {

namespace {

using Firsts = std::array<std::size_t, VectorMonomials::kVectors + 1>;

double factorial(std::ptrdiff_t n) {
  return n <= 1 ? 1.0 : n == 2 ? 2.0 : 6.0;
}

/// The kind of the product of the variables with these numbers, in rising order.
VectorMonomials::Kind kind_of(const std::vector<std::size_t>& factors, const Firsts& firsts) {
  // The number of orders of equal factors, over that of all of a vector.
  double weight = 1.0;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (i == 0 || factors[i] != factors[i - 1]) {
      weight *= factorial(std::count(factors.begin(), factors.end(), factors[i]));
    }
  }
  std::array<std::ptrdiff_t, VectorMonomials::kVectors> degrees{};
  for (std::size_t k = 0; k < degrees.size(); ++k) {
    const auto is_of_vector = [&](std::size_t i) { return i >= firsts[k] && i < firsts[k + 1]; };
    degrees[k] = std::count_if(factors.begin(), factors.end(), is_of_vector);
    weight /= factorial(degrees[k]);
  }
  constexpr double kUpward = 1.0 + 0x1p-49;
  return {static_cast<int>(degrees[0]),
          static_cast<std::size_t>(degrees[1] * (VectorMonomials::kMostDegree + 1) + degrees[2]),
          weight * kUpward};
}

}  // namespace

VectorMonomials::VectorMonomials(std::size_t x, std::size_t v, std::size_t w)
    : firsts_{0, x, x + v, x + v + w}, variables_(x + v + w), kinds_(kMostDegree + 1) {
  constexpr std::size_t kMostVariables = 20;
  if (variables_ == 0 || std::max({x, v, w, variables_}) > kMostVariables) {
    throw std::invalid_argument("no such vectors");
  }
  const std::size_t n = variables_;
  const std::size_t all_pairs = n * (n + 1) / 2;
  pairs_.resize(n * n);
  triples_.resize(n * all_pairs);
  kinds_[0].push_back(kind_of({}, firsts_));
  for (std::size_t i = 0; i < n; ++i) {
    kinds_[1].push_back(kind_of({i}, firsts_));
    for (std::size_t j = i; j < n; ++j) {
      pairs_[i * n + j] = pairs_[j * n + i] = static_cast<std::uint32_t>(kinds_[2].size());
      kinds_[2].push_back(kind_of({i, j}, firsts_));
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j < n; ++j) {
      for (std::size_t k = j; k < n; ++k) {
        const auto number = static_cast<std::uint32_t>(kinds_[3].size());
        kinds_[3].push_back(kind_of({i, j, k}, firsts_));
        triples_[i * all_pairs + pair(j, k)] = number;
        triples_[j * all_pairs + pair(i, k)] = number;
        triples_[k * all_pairs + pair(i, j)] = number;
      }
    }
  }
}

}  // namespace veritrack::checker
