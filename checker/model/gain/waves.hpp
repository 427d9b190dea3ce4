// Sums of waves of the samples' phase and of angles (docs/gain-proof.md, section 2): what samples, sines and
// cosines and their products are before they are linear in anything. Their factors are exact, so that what
// cancels is gone.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "checker/model/gain/linear_frame.hpp"

namespace veritrack::checker {

/// |y|^length e^(j (turns arg y + sum of times L)), times named constants. In one channel
/// v^noise A^length e^(j (turns phi' + sum of times L)), with the noise v and the phase phi' of the sample.
/// Times powers of linear values without turns, by their numbers, and of the lengths of vectors of states,
/// which are positive and not known.
struct Wave {
  std::vector<int> constants;  ///< in order
  int length = 0;
  int turns = 0;
  std::vector<std::pair<int, int>>
      angles;     ///< the numbers of the values L, in order, and times that are not 0
  int noise = 0;  ///< in one channel
  /// Numbers, in order, and powers that are not 0; -1 - i: of the vector whose real part is state i.
  std::vector<std::pair<int, int>> lengths = {};
  [[nodiscard]] bool is_real() const { return turns == 0 && angles.empty(); }
  [[nodiscard]] bool has_unknown_length() const { return !lengths.empty() && lengths.front().first < 0; }
  // clang-tidy 14 takes the 0 of a comparison for a null pointer.
  auto operator<=>(const Wave&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// The sum of Re(conj(gamma) M), with gamma = (real, imaginary) in units of 2^-16, and no zeros. Only one of
/// a wave and its conjugate is there: that whose first number of turns or times is positive.
using Waves = std::map<Wave, std::array<std::int64_t, 2>>;

/// The samples: the real and the imaginary part of y.
Waves sample_waves(std::size_t channel);
/// The sample of one channel: A cos(phi') + v.
Waves sample_of_one_channel();
/// cos and sin of a value.
Waves cosine_wave(int value);
Waves sine_wave(int value);
Waves constant_wave(const ConstantFactors& constant);
/// The real (0) or the imaginary (1) part of a vector at this angle, with this length.
Waves vector_waves(int length, int angle, int part);
/// A linear value as a factor.
Waves length_wave(int value);

Waves sum(const Waves& x, const Waves& y);
Waves negated(const Waves& x);
Waves product(const Waves& x, const Waves& y);
/// Whether there is noise of one channel in it.
bool has_noise(const Waves& x);
/// The wave, if the sum is a positive power of |y| times powers of lengths and nothing else.
std::optional<Wave> product_of_lengths(const Waves& x);
/// 1/M of such a wave.
Wave reciprocal(const Wave& wave);
/// Its root, if all powers are even.
std::optional<Wave> root(const Wave& wave);
Waves times(const Waves& x, const Wave& wave);
/// The same for the same waves, or sums of waves, only.
std::string name_of(const Wave& wave);
std::string name_of(const Waves& x);

}  // namespace veritrack::checker
