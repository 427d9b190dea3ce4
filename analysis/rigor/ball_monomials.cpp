#include "analysis/rigor/ball_monomials.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::rigor {

namespace {

using Exponents = std::vector<int>;

/// All exponents of so many variables and that degree.
std::vector<Exponents> exponents_of(int variables, int degree) {
  if (variables == 0) {
    return degree == 0 ? std::vector<Exponents>{{}} : std::vector<Exponents>{};
  }
  std::vector<Exponents> all;
  for (int first = degree; first >= 0; --first) {
    for (Exponents rest : exponents_of(variables - 1, degree - first)) {
      rest.insert(rest.begin(), first);
      all.push_back(std::move(rest));
    }
  }
  return all;
}

double factorial(int n) {
  return n <= 1 ? 1.0 : n * factorial(n - 1);
}

/// alpha! / |alpha|!, rounded in the mode that is held.
double weight(const Exponents& exponents, std::size_t first, std::size_t count) {
  int degree = 0;
  double product = 1.0;
  for (std::size_t i = first; i < first + count; ++i) {
    degree += exponents[i];
    product *= factorial(exponents[i]);
  }
  return product / factorial(degree);
}

}  // namespace

const BallMonomials& BallMonomials::of(int balls, int disturbances) {
  if (balls < 0 || balls > 16 || disturbances < 0 || disturbances > 3) {
    throw std::invalid_argument(
        "ball models have at most 16 variables in the ball and at most 3 disturbances");
  }
  static std::mutex mutex;
  static std::map<std::pair<int, int>, std::unique_ptr<BallMonomials>> made;
  const std::scoped_lock lock(mutex);
  std::unique_ptr<BallMonomials>& entry = made[{balls, disturbances}];
  if (entry == nullptr) {
    entry.reset(new BallMonomials(balls, disturbances));  // NOLINT(cppcoreguidelines-owning-memory)
  }
  return *entry;
}

BallMonomials::BallMonomials(int balls, int disturbances) : balls_(balls), disturbances_(disturbances) {
  const UpwardRounding upward;
  // The exponents of x and v in a row, then those of s and z.
  std::map<Exponents, std::size_t> numbers;
  std::vector<Exponents> monomials;
  for (int total = 0; total <= kMost; ++total) {
    for (int ball = 0; ball <= (balls == 0 ? 0 : total); ++ball) {
      for (int disturbance = 0; ball + disturbance <= total && ball + disturbance <= kMostOfVectors;
           ++disturbance) {
        if (disturbances == 0 && disturbance > 0) {
          break;
        }
        for (int s = total - ball - disturbance; s >= 0; --s) {
          const int z = total - ball - disturbance - s;
          Class here{ball, disturbance, s, z, monomials.size(), 0};
          for (const Exponents& of_x : exponents_of(balls, ball)) {
            for (const Exponents& of_v : exponents_of(disturbances, disturbance)) {
              Exponents all = of_x;
              all.insert(all.end(), of_v.begin(), of_v.end());
              const auto x = static_cast<std::size_t>(balls);
              weights_.push_back(weight(all, 0, x) * weight(all, x, static_cast<std::size_t>(disturbances)));
              all.insert(all.end(), {s, z});
              numbers[all] = monomials.size();
              monomials.push_back(std::move(all));
            }
          }
          here.last = monomials.size();
          classes_.push_back(here);
        }
      }
    }
  }
  groups_.reserve(classes_.size());
  for (const Class& here : classes_) {
    groups_.push_back(static_cast<std::uint8_t>(group_of(here)));
  }
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    first_pair_.push_back(pairs_.size());
    for (std::size_t j = 0; j < classes_.size(); ++j) {
      if (!is_kept(groups_[i], groups_[j])) {
        continue;
      }
      const Class& a = classes_[i];
      const Class& b = classes_[j];
      const std::size_t c = class_of(a.ball + b.ball, a.disturbance + b.disturbance, a.s + b.s, a.z + b.z);
      const std::size_t first = products_.size();
      for (std::size_t p = a.first; p < a.last; ++p) {
        for (std::size_t q = b.first; q < b.last; ++q) {
          Exponents sum = monomials[p];
          for (std::size_t k = 0; k < sum.size(); ++k) {
            sum[k] += monomials[q][k];
          }
          products_.push_back({static_cast<std::uint16_t>(p), static_cast<std::uint16_t>(q),
                               static_cast<std::uint16_t>(numbers.at(sum))});
        }
      }
      // The terms of a class are in the order of their exponents of x and v, whatever those of s and z.
      const bool is_multiple = a.ball + a.disturbance == 0 || b.ball + b.disturbance == 0;
      pairs_.push_back({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j),
                        static_cast<std::uint16_t>(c), is_multiple, static_cast<std::uint32_t>(first),
                        static_cast<std::uint32_t>(products_.size())});
    }
  }
  first_pair_.push_back(pairs_.size());
}

std::size_t BallMonomials::class_of(int ball, int disturbance, int s, int z) const {
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    const Class& here = classes_[i];
    if (here.ball == ball && here.disturbance == disturbance && here.s == s && here.z == z) {
      return i;
    }
  }
  throw std::invalid_argument("no monomials of these degrees are kept");
}

}  // namespace veritrack::rigor
