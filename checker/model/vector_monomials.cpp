#include "checker/model/vector_monomials.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace veritrack::checker {

namespace {

/// Of the variables with these numbers, in rising order.
VectorMonomials::Kind kind_of(const std::vector<std::size_t>& factors, std::size_t balls) {
  // The number of orders of equal factors, over that of all of a vector.
  const auto factorial = [](std::ptrdiff_t n) { return n <= 1 ? 1.0 : n == 2 ? 2.0 : 6.0; };
  double repeated = 1.0;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (i == 0 || factors[i] != factors[i - 1]) {
      repeated *= factorial(std::count(factors.begin(), factors.end(), factors[i]));
    }
  }
  const auto of_v = std::count_if(factors.begin(), factors.end(), [&](std::size_t i) { return i >= balls; });
  const auto of_x = static_cast<std::ptrdiff_t>(factors.size()) - of_v;
  constexpr double kUpward = 1.0 + 0x1p-50;
  return {static_cast<int>(of_v), repeated / (factorial(of_x) * factorial(of_v)) * kUpward};
}

}  // namespace

VectorMonomials::VectorMonomials(std::size_t balls, std::size_t disturbances)
    : balls_(balls), variables_(balls + disturbances), kinds_(kMostDegree + 1) {
  constexpr std::size_t kMostVariables = 20;
  if (variables_ == 0 || balls > kMostVariables || variables_ > kMostVariables) {
    throw std::invalid_argument("no such vectors");
  }
  const std::size_t n = variables_;
  const std::size_t all_pairs = n * (n + 1) / 2;
  pairs_.resize(n * n);
  triples_.resize(n * all_pairs);
  kinds_[0].push_back(kind_of({}, balls));
  for (std::size_t i = 0; i < n; ++i) {
    kinds_[1].push_back(kind_of({i}, balls));
    for (std::size_t j = i; j < n; ++j) {
      pairs_[i * n + j] = pairs_[j * n + i] = static_cast<std::uint32_t>(kinds_[2].size());
      kinds_[2].push_back(kind_of({i, j}, balls));
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j < n; ++j) {
      for (std::size_t k = j; k < n; ++k) {
        const auto number = static_cast<std::uint32_t>(kinds_[3].size());
        kinds_[3].push_back(kind_of({i, j, k}, balls));
        triples_[i * all_pairs + pair(j, k)] = number;
        triples_[j * all_pairs + pair(i, k)] = number;
        triples_[k * all_pairs + pair(i, j)] = number;
      }
    }
  }
}

}  // namespace veritrack::checker
