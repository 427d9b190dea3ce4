#include "checker/model/series_evidence.hpp"

#include <stdexcept>

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostHarmonics = 512;

}  // namespace

double double_from(const Tree& number) {
  const Ball exact = exact_number(number);
  const double value = exact.near();
  if (!certainly_equal(exact, Ball(value))) {
    throw std::invalid_argument("a number that is not in the range of doubles");
  }
  return value;
}

std::vector<double> doubles_from(const Tree& list) {
  std::vector<double> values;
  values.reserve(list.elements().size());
  for (const Tree& number : list.elements()) {
    values.push_back(double_from(number));
  }
  return values;
}

std::vector<PhaseSeries> series_from(const Tree& list) {
  std::vector<PhaseSeries> all;
  for (const Tree& series : list.elements()) {
    all.emplace_back();
    for (const Tree& harmonic : series.elements()) {
      all.back().emplace_back();
      for (const Tree& coefficient : harmonic.elements()) {
        if (coefficient.elements().size() != 2) {
          throw Malformed("a coefficient has a real and an imaginary part");
        }
        all.back().back().emplace_back(double_from(coefficient.at(0)), double_from(coefficient.at(1)));
      }
      if (all.back().back().size() > kMostPowers || all.back().size() > kMostHarmonics) {
        throw Malformed("a series of too many terms");
      }
    }
  }
  return all;
}

}  // namespace veritrack::checker
