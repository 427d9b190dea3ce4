#include "trackers/quadrature/batch/quadrature_batch.hpp"

#include <stdexcept>

#include "trackers/quadrature/batch/quadrature_lanes.hpp"

namespace veritrack::trackers {

template <typename Scalar>
QuadratureBatch<Scalar>::QuadratureBatch(const std::vector<ToneModel<Scalar>>& designs,
                                         const std::vector<QuadratureEstimate<Scalar>>& starts)
    : size_(designs.size()), groups_((size_ + kGroup - 1) / kGroup) {
  if (starts.size() != size_) {
    throw std::invalid_argument("as many starts as designs");
  }
  for (std::size_t t = 0; t < groups_.size() * kGroup; ++t) {
    // The last group is filled up with copies, so that no lane computes with numbers that are none.
    const ToneModel<Scalar>& design = designs[t < size_ ? t : size_ - 1];
    const QuadratureEstimate<Scalar>& start = starts[t < size_ ? t : size_ - 1];
    const FactoredCovariance<Scalar>& p = start.covariance;
    const std::array<Scalar, kNumbers> numbers{design.q1,           design.q2,        design.r,
                                               design.epsilon,      start.in_phase,   start.quadrature,
                                               start.frequency,     p.conditional_11, p.conditional_12,
                                               p.conditional_22,    p.regression_1,   p.regression_2,
                                               p.frequency_variance};
    for (std::size_t row = 0; row < kNumbers; ++row) {
      groups_[t / kGroup][row][t % kGroup] = numbers[row];
    }
  }
}

template <typename Scalar>
QuadratureEstimate<Scalar> QuadratureBatch<Scalar>::filtered(std::size_t t) const {
  const auto number = [&](std::size_t row) { return groups_.at(t / kGroup)[row][t % kGroup]; };
  return {
      number(4), number(5), number(6), {number(7), number(8), number(9), number(10), number(11), number(12)}};
}

template <typename Scalar>
void QuadratureBatch<Scalar>::run(const BatchSamples<Scalar>& samples, const BatchTargets<Scalar>& targets,
                                  std::size_t first, std::size_t last, InstructionSet set) {
  const bool is_part = first % kGroup == 0 && (last == size_ || (last < size_ && last % kGroup == 0));
  if (!is_part || !has(set)) {
    throw std::invalid_argument("an invalid part of the batch, or instructions that this processor lacks");
  }
  if (first == last) {
    return;
  }
  Scalar* groups = groups_.front().front().data();
  switch (set) {
    case InstructionSet::sse2:
      return detail::run_groups_sse2(groups, samples, targets, first, last);
    case InstructionSet::avx2:
      return detail::run_groups_avx2(groups, samples, targets, first, last);
    case InstructionSet::avx512:
      return detail::run_groups_avx512(groups, samples, targets, first, last);
  }
}

template class QuadratureBatch<double>;
template class QuadratureBatch<float>;

}  // namespace veritrack::trackers
