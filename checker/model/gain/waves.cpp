#include "checker/model/gain/waves.hpp"

#include <algorithm>
#include <cstdlib>

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostWaves = 256;
constexpr int kLargestPower = 64;

/// Adds Re(conj(gamma) M).
void add_wave(Waves& sum, Wave wave, std::array<std::int64_t, 2> gamma) {
  spend(50);
  std::erase_if(wave.angles, [](const auto& angle) { return angle.second == 0; });
  const int first = wave.turns != 0 ? wave.turns : wave.angles.empty() ? 0 : wave.angles.front().second;
  if (first < 0) {
    wave.turns = -wave.turns;
    for (auto& angle : wave.angles) {
      angle.second = -angle.second;
    }
    gamma[1] = -gamma[1];
  }
  if (first == 0) {
    gamma[1] = 0;  // M is real
  }
  std::erase_if(wave.lengths, [](const auto& length) { return length.second == 0; });
  bool is_large = std::abs(wave.length) > kLargestPower || wave.noise > kLargestPower ||
                  std::abs(wave.turns) > kLargestPower;
  for (const auto& length : wave.lengths) {
    is_large = is_large || std::abs(length.second) > kLargestPower;
  }
  for (const auto& angle : wave.angles) {
    is_large = is_large || std::abs(angle.second) > kLargestPower;
  }
  if (is_large || wave.constants.size() > kLargestPower || sum.size() > kMostWaves) {
    throw NotCovered("too many waves, or too large powers");
  }
  const auto place = sum.try_emplace(std::move(wave), std::array<std::int64_t, 2>{0, 0}).first;
  place->second = {exact_sum(place->second[0], gamma[0]), exact_sum(place->second[1], gamma[1])};
  if (place->second[0] == 0 && place->second[1] == 0) {
    sum.erase(place);
  }
}

/// M_x M_y, or M_x conj(M_y) where sign = -1.
Wave product_of(const Wave& x, const Wave& y, int sign) {
  Wave result = x;
  result.constants.insert(result.constants.end(), y.constants.begin(), y.constants.end());
  std::sort(result.constants.begin(), result.constants.end());
  result.length += y.length;
  result.turns += sign * y.turns;
  result.noise += y.noise;
  std::map<int, int> angles(x.angles.begin(), x.angles.end());
  for (const auto& [angle, times] : y.angles) {
    angles[angle] += sign * times;
  }
  result.angles.assign(angles.begin(), angles.end());
  std::map<int, int> lengths(x.lengths.begin(), x.lengths.end());
  for (const auto& [length, power] : y.lengths) {
    lengths[length] += power;
  }
  result.lengths.assign(lengths.begin(), lengths.end());
  return result;
}

}  // namespace

std::string name_of(const Wave& wave) {
  std::string name = std::to_string(wave.noise) + " " + std::to_string(wave.length) + " " +
                     std::to_string(wave.turns) + " (";
  for (const int constant : wave.constants) {
    name += std::to_string(constant) + " ";
  }
  name += ")";
  for (const auto& [angle, times] : wave.angles) {
    name += " " + std::to_string(times) + "*" + std::to_string(angle);
  }
  for (const auto& [length, power] : wave.lengths) {
    name += " |" + std::to_string(length) + "|^" + std::to_string(power);
  }
  return name;
}

Waves sample_waves(std::size_t channel) {
  return {{Wave{{}, 1, 1, {}}, channel == 0 ? std::array<std::int64_t, 2>{kExactUnit, 0}
                                            : std::array<std::int64_t, 2>{0, kExactUnit}}};
}

Waves sample_of_one_channel() {
  return {{Wave{{}, 1, 1, {}, 0}, {kExactUnit, 0}}, {Wave{{}, 0, 0, {}, 1}, {kExactUnit, 0}}};
}

bool has_noise(const Waves& x) {
  return std::any_of(x.begin(), x.end(), [](const auto& entry) { return entry.first.noise != 0; });
}

Waves cosine_wave(int value) {
  return {{Wave{{}, 0, 0, {{value, 1}}}, {kExactUnit, 0}}};
}

Waves sine_wave(int value) {
  return {{Wave{{}, 0, 0, {{value, 1}}}, {0, kExactUnit}}};
}

Waves constant_wave(const ConstantFactors& constant) {
  Waves result;
  add_wave(result, Wave{constant.named, 0, 0, {}}, {constant.exact, 0});
  return result;
}

Waves vector_waves(int length, int angle, int part) {
  const Wave wave{{}, 0, 0, {{angle, 1}}, 0, {{length, 1}}};
  return {{wave, part == 0 ? std::array<std::int64_t, 2>{kExactUnit, 0}
                           : std::array<std::int64_t, 2>{0, kExactUnit}}};
}

Waves sum(const Waves& x, const Waves& y) {
  Waves result = x;
  for (const auto& [wave, gamma] : y) {
    add_wave(result, wave, gamma);
  }
  return result;
}

Waves negated(const Waves& x) {
  Waves result = x;
  for (auto& entry : result) {
    entry.second = {-entry.second[0], -entry.second[1]};
  }
  return result;
}

Waves product(const Waves& x, const Waves& y) {
  // Re a Re b = Re(a b)/2 + Re(a conj(b))/2; a real wave needs no halves.
  Waves result;
  for (const auto& [wave, gamma] : x) {
    for (const auto& [other, delta] : y) {
      if (wave.is_real() || other.is_real()) {
        // One of gamma and delta is real.
        add_wave(result, product_of(wave.is_real() ? other : wave, wave.is_real() ? wave : other, 1),
                 {exact_sum(exact_product(gamma[0], delta[0]), -exact_product(gamma[1], delta[1])),
                  exact_sum(exact_product(gamma[0], delta[1]), exact_product(gamma[1], delta[0]))});
        continue;
      }
      const auto half_product = [&left = gamma, &right = delta](std::size_t i, std::size_t j) {
        return exact_product(left[i], right[j], 1);
      };
      add_wave(result, product_of(wave, other, 1),
               {exact_sum(half_product(0, 0), -half_product(1, 1)),
                exact_sum(half_product(0, 1), half_product(1, 0))});
      add_wave(result, product_of(wave, other, -1),
               {exact_sum(half_product(0, 0), half_product(1, 1)),
                exact_sum(half_product(1, 0), -half_product(0, 1))});
    }
  }
  return result;
}

Waves length_wave(int value) {
  return {{Wave{{}, 0, 0, {}, 0, {{value, 1}}}, {kExactUnit, 0}}};
}

std::optional<Wave> product_of_lengths(const Waves& x) {
  if (x.size() != 1) {
    return std::nullopt;
  }
  const auto& [wave, gamma] = *x.begin();
  const bool is_product = wave == Wave{{}, wave.length, 0, {}, 0, wave.lengths} && gamma[0] == kExactUnit &&
                          (wave.length > 0 || (wave.length == 0 && !wave.lengths.empty()));
  return is_product ? std::optional(wave) : std::nullopt;
}

Wave reciprocal(const Wave& wave) {
  Wave result = wave;
  result.length = -wave.length;
  for (auto& length : result.lengths) {
    length.second = -length.second;
  }
  return result;
}

std::optional<Wave> root(const Wave& wave) {
  Wave result = wave;
  bool is_even = wave.length % 2 == 0;
  result.length /= 2;
  for (auto& length : result.lengths) {
    is_even = is_even && length.second % 2 == 0;
    length.second /= 2;
  }
  return is_even ? std::optional(result) : std::nullopt;
}

Waves times(const Waves& x, const Wave& wave) {
  return product(x, {{wave, {kExactUnit, 0}}});
}

std::string name_of(const Waves& x) {
  std::string name = "waves";
  for (const auto& [wave, gamma] : x) {
    name += " + " + std::to_string(gamma[0]) + "," + std::to_string(gamma[1]) + " " + name_of(wave);
  }
  return name;
}

}  // namespace veritrack::checker
