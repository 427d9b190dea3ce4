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
struct BatchSamples {
  const double* samples;
  std::size_t stride;
  std::size_t length;
};

/// Where a batch writes, row t * length + k for the sample k of tracker t; null: not wanted.
struct BatchTargets {
  double* state = nullptr;       ///< 3 a row: in-phase and quadrature part, frequency
  double* deviation = nullptr;   ///< of the frequency, as the tracker believes
  double* innovation = nullptr;  ///< 2 a row; NaN where a sample is missing
  double* nis = nullptr;         ///< the normalised innovation squared; NaN where a sample is missing
};

/// The trackers with their memory, as a structure of arrays. The results do not depend on the set of
/// instructions, nor on how many trackers there are; over double they differ from those of QuadratureEkf only
/// in what packed.hpp says of sine and cosine.
class QuadratureBatch {
 public:
  static constexpr std::size_t kGroup = 8;     ///< number of trackers in a group
  static constexpr std::size_t kNumbers = 13;  ///< of a tracker: q1, q2, r, epsilon, and its estimate

  QuadratureBatch(const std::vector<ToneModel<double>>& designs,
                  const std::vector<QuadratureEstimate<double>>& starts);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// The filtered estimate of tracker t.
  [[nodiscard]] QuadratureEstimate<double> filtered(std::size_t t) const;

  /// Takes all samples, for the trackers from `first` to before `last`, both multiples of
  /// kGroup, or the end. A sample
  /// with NaN is missing: the tracker predicts. Needs round-to-nearest without flushed denormals; does not
  /// allocate. Throws std::invalid_argument where this processor lacks the instructions.
  void run(const BatchSamples& samples, const BatchTargets& targets, std::size_t first, std::size_t last,
           InstructionSet set = widest_instruction_set());
  void run(const BatchSamples& samples, const BatchTargets& targets,
           InstructionSet set = widest_instruction_set()) {
    run(samples, targets, 0, size_, set);
  }

 private:
  using Group = std::array<std::array<double, kGroup>, kNumbers>;
  std::size_t size_;
  std::vector<Group> groups_;
};

}  // namespace veritrack::trackers
