// Many quadrature trackers side by side: each as quadrature_ekf.hpp has it, several in one register.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "trackers/instruction_set.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace veritrack::trackers {

/// Where the samples of a batch are: those of tracker t at samples + t * stride, in-phase and quadrature part
/// one after the other, `length` of each. A stride of 0: the same for all.
template <typename Scalar>
struct BatchSamples {
  const Scalar* samples;
  std::size_t stride;
  std::size_t length;
};

/// Where a batch writes, row t * length + k for the sample k of tracker t; null: not wanted.
template <typename Scalar>
struct BatchTargets {
  Scalar* state = nullptr;       ///< 3 a row: in-phase and quadrature part, frequency
  Scalar* deviation = nullptr;   ///< of the frequency, as the tracker believes
  Scalar* innovation = nullptr;  ///< 2 a row; NaN where a sample is missing
  Scalar* nis = nullptr;         ///< the normalised innovation squared; NaN where a sample is missing
};

/// The trackers with their memory, as a structure of arrays, over double or float. The results do not depend
/// on the set of instructions, nor on how many trackers there are; they differ from those of
/// QuadratureEkf<Scalar> only in what packed_sine_cosine.hpp says of sine and cosine.
template <typename Scalar = double>
class QuadratureBatch {
 public:
  static constexpr std::size_t kGroup = 256 / sizeof(Scalar);  ///< number of trackers in a group
  static constexpr std::size_t kNumbers = 13;  ///< of a tracker: q1, q2, r, epsilon, and its estimate

  QuadratureBatch(const std::vector<ToneModel<Scalar>>& designs,
                  const std::vector<QuadratureEstimate<Scalar>>& starts);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// The filtered estimate of tracker t.
  [[nodiscard]] QuadratureEstimate<Scalar> filtered(std::size_t t) const;

  /// Takes all samples, for the trackers from `first` to before `last`, both multiples of kGroup, or the end.
  /// A sample with NaN is missing: the tracker predicts. Needs round-to-nearest without flushed denormals;
  /// does not allocate. Throws std::invalid_argument where this processor lacks the instructions.
  void run(const BatchSamples<Scalar>& samples, const BatchTargets<Scalar>& targets, std::size_t first,
           std::size_t last, InstructionSet set = widest_instruction_set());
  void run(const BatchSamples<Scalar>& samples, const BatchTargets<Scalar>& targets,
           InstructionSet set = widest_instruction_set()) {
    run(samples, targets, 0, size_, set);
  }

 private:
  using Group = std::array<std::array<Scalar, kGroup>, kNumbers>;
  std::size_t size_;
  std::vector<Group> groups_;
};

extern template class QuadratureBatch<double>;
extern template class QuadratureBatch<float>;

}  // namespace veritrack::trackers
