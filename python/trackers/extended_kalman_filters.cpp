// The extended Kalman filters of one tone.
#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "python/trackers/recordings.hpp"
#include "trackers/quadrature/batch/quadrature_batch.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

namespace veritrack::python {

namespace {

using Covariance = trackers::FactoredCovariance<double>;
using Estimate = trackers::ToneEstimate<double>;

/// A symmetric matrix from its nine entries, row by row.
Covariance covariance_from(const double* entries) {
  return Covariance::from_matrix(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(entries));
}

Estimate start_from(const double* state, const double* covariance) {
  return {state[0], state[1], state[2], covariance_from(covariance)};
}

std::array<double, 3> values_of(const Estimate& estimate) {
  return {estimate.in_phase, estimate.quadrature, estimate.frequency};
}

struct QuadratureTracker {
  static constexpr std::size_t kChannels = 2;
  static constexpr std::size_t kValues = 3;

  trackers::QuadratureEkf<double> ekf;

  [[nodiscard]] const Estimate& estimate() const { return ekf.filtered(); }

  Said<2, 3> step(const double* sample) {
    if (std::isnan(sample[0]) || std::isnan(sample[1])) {
      ekf.time_update();
      ekf = trackers::QuadratureEkf<double>(ekf.design(), ekf.predicted());
      return {values_of(ekf.filtered()),
              std::sqrt(ekf.filtered().covariance.frequency_variance),
              {kNone, kNone},
              kNone};
    }
    ekf.step(sample[0], sample[1]);
    const Estimate& predicted = ekf.predicted();
    const Covariance& p = predicted.covariance;
    const double r = ekf.design().r;
    const double s11 = p.conditional_11 + p.frequency_variance * p.regression_1 * p.regression_1 + r;
    const double s12 = p.conditional_12 + p.frequency_variance * p.regression_1 * p.regression_2;
    const double s22 = p.conditional_22 + p.frequency_variance * p.regression_2 * p.regression_2 + r;
    const double v1 = sample[0] - predicted.in_phase;
    const double v2 = sample[1] - predicted.quadrature;
    return {values_of(ekf.filtered()),
            std::sqrt(ekf.filtered().covariance.frequency_variance),
            {v1, v2},
            (s22 * v1 * v1 - 2.0 * s12 * v1 * v2 + s11 * v2 * v2) / (s11 * s22 - s12 * s12)};
  }
};

struct SingleChannelTracker {
  static constexpr std::size_t kChannels = 1;
  static constexpr std::size_t kValues = 3;

  trackers::SingleChannelEkf<double> ekf;

  [[nodiscard]] const Estimate& estimate() const { return ekf.filtered(); }

  Said<1, 3> step(const double* sample) {
    if (std::isnan(*sample)) {
      ekf.time_update();
      ekf = trackers::SingleChannelEkf<double>(ekf.design(), ekf.predicted());
      return {
          values_of(ekf.filtered()), std::sqrt(ekf.filtered().covariance.frequency_variance), {kNone}, kNone};
    }
    ekf.step(*sample);
    const Estimate& predicted = ekf.predicted();
    const Covariance& p = predicted.covariance;
    const double variance =
        p.conditional_11 + p.frequency_variance * p.regression_1 * p.regression_1 + ekf.design().r;
    const double innovation = *sample - predicted.in_phase;
    return {values_of(ekf.filtered()),
            std::sqrt(ekf.filtered().covariance.frequency_variance),
            {innovation},
            innovation * innovation / variance};
  }
};

/// Designs and starts: `design`: (size, 4), q1, q2, r, epsilon; `state`: (size, 3); `covariance`: (size, 9),
/// P(0|0).
std::pair<std::vector<trackers::ToneModel<double>>, std::vector<Estimate>> quadrature_starts(
    const Array& design, const Array& state, const Array& covariance) {
  require_shape(design, 4);
  require_shape(state, 3);
  require_shape(covariance, 9);
  std::vector<trackers::ToneModel<double>> designs;
  std::vector<Estimate> starts;
  for (std::size_t i = 0; i < static_cast<std::size_t>(design.shape(0)); ++i) {
    const double* chosen = row_of(design, i);
    designs.push_back({chosen[0], chosen[1], chosen[2], chosen[3]});
    starts.push_back(start_from(row_of(state, i), row_of(covariance, i)));
  }
  return {designs, starts};
}

std::vector<QuadratureTracker> quadrature_trackers(const Array& design, const Array& state,
                                                   const Array& covariance) {
  const auto [designs, starts] = quadrature_starts(design, state, covariance);
  std::vector<QuadratureTracker> trackers;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    trackers.push_back({trackers::QuadratureEkf<double>(designs[i], starts[i])});
  }
  return trackers;
}

template <typename Scalar>
using ArrayOf = py::array_t<Scalar, py::array::c_style | py::array::forcecast>;

trackers::ToneModel<float> rounded(const trackers::ToneModel<double>& d) {
  const auto to = [](double x) { return static_cast<float>(x); };
  return {to(d.q1), to(d.q2), to(d.r), to(d.epsilon)};
}

/// The same numbers in another format, rounded to nearest.
template <typename To, typename From>
trackers::ToneEstimate<To> converted(const trackers::ToneEstimate<From>& estimate) {
  const auto to = [](From x) { return static_cast<To>(x); };
  const trackers::FactoredCovariance<From>& p = estimate.covariance;
  return {to(estimate.in_phase),
          to(estimate.quadrature),
          to(estimate.frequency),
          {to(p.conditional_11), to(p.conditional_12), to(p.conditional_22), to(p.regression_1),
           to(p.regression_2), to(p.frequency_variance)}};
}

/// Those of trackers/quadrature/batch/, with the interface of Batch, in double or single precision.
template <typename Scalar>
class PackedQuadratureBatch {
 public:
  PackedQuadratureBatch(const Array& design, const Array& state, const Array& covariance)
      : batch_(made(design, state, covariance)) {}

  [[nodiscard]] std::size_t size() const { return batch_.size(); }
  [[nodiscard]] Estimate estimate(std::size_t i) const { return converted<double>(batch_.filtered(i)); }

  /// As Batch::run; instructions: "sse2", "avx2" or "avx512", or "" for the widest.
  py::tuple run(const ArrayOf<Scalar>& samples, std::size_t threads, const std::string& instructions) {
    const trackers::InstructionSet set = named(instructions);
    require_samples(samples, 2, size());
    const auto length = static_cast<std::size_t>(samples.shape(1));
    const std::size_t stride = samples.shape(0) == 1 ? 0 : length * 2;
    ArrayOf<Scalar> state({size(), length, std::size_t{3}});
    ArrayOf<Scalar> deviation({size(), length});
    ArrayOf<Scalar> innovation({size(), length, std::size_t{2}});
    ArrayOf<Scalar> nis({size(), length});
    const trackers::BatchTargets<Scalar> targets{state.mutable_data(), deviation.mutable_data(),
                                                 innovation.mutable_data(), nis.mutable_data()};
    const Scalar* input = samples.data();
    trackers::QuadratureBatch<Scalar> moved = batch_;
    {
      const py::gil_scoped_release free;
      constexpr std::size_t kGroup = trackers::QuadratureBatch<Scalar>::kGroup;
      in_threads((size() + kGroup - 1) / kGroup, threads,
                 [&](std::size_t first, std::size_t last, Interruption& interruption) {
                   const TrackerArithmetic arithmetic;
                   for (std::size_t group = first; group < last; ++group) {
                     interruption.look();
                     moved.run({input, stride, length}, targets, group * kGroup,
                               std::min((group + 1) * kGroup, size()), set);
                   }
                 });
    }
    batch_ = std::move(moved);
    return py::make_tuple(state, deviation, innovation, nis);
  }

 private:
  static trackers::QuadratureBatch<Scalar> made(const Array& design, const Array& state,
                                                const Array& covariance) {
    const TrackerArithmetic arithmetic;
    const auto [designs, starts] = quadrature_starts(design, state, covariance);
    if constexpr (std::is_same_v<Scalar, double>) {
      return {designs, starts};
    } else {
      std::vector<trackers::ToneModel<Scalar>> rounded_designs;
      std::vector<trackers::ToneEstimate<Scalar>> rounded_starts;
      for (std::size_t i = 0; i < designs.size(); ++i) {
        rounded_designs.push_back(rounded(designs[i]));
        rounded_starts.push_back(converted<Scalar>(starts[i]));
      }
      return {rounded_designs, rounded_starts};
    }
  }
  static trackers::InstructionSet named(const std::string& instructions) {
    using trackers::InstructionSet;
    const InstructionSet set = instructions == "sse2"     ? InstructionSet::sse2
                               : instructions == "avx2"   ? InstructionSet::avx2
                               : instructions == "avx512" ? InstructionSet::avx512
                                                          : trackers::widest_instruction_set();
    if (!trackers::has(set)) {
      throw std::invalid_argument("this processor has no " + instructions);
    }
    return set;
  }
  trackers::QuadratureBatch<Scalar> batch_;
};

/// The sets that this processor has, the widest last.
std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const auto& [set, name] :
       {std::pair(trackers::InstructionSet::sse2, "sse2"), std::pair(trackers::InstructionSet::avx2, "avx2"),
        std::pair(trackers::InstructionSet::avx512, "avx512")}) {
    if (trackers::has(set)) {
      names.emplace_back(name);
    }
  }
  return names;
}

/// `process_noise`: (size, 9); `design`: (size, 2), r, epsilon; the rest as above.
std::vector<SingleChannelTracker> single_channel_trackers(const Array& process_noise, const Array& design,
                                                          const Array& state, const Array& covariance) {
  require_shape(process_noise, 9);
  require_shape(design, 2);
  require_shape(state, 3);
  require_shape(covariance, 9);
  std::vector<SingleChannelTracker> trackers;
  for (std::size_t i = 0; i < static_cast<std::size_t>(design.shape(0)); ++i) {
    const trackers::SingleChannelEkfDesign<double> model{covariance_from(row_of(process_noise, i)),
                                                         row_of(design, i)[0], row_of(design, i)[1]};
    trackers.push_back(
        {trackers::SingleChannelEkf<double>(model, start_from(row_of(state, i), row_of(covariance, i)))});
  }
  return trackers;
}

template <typename Tracker>
Estimate estimate_of(const Batch<Tracker>& batch, std::size_t i) {
  return batch.trackers()[i].estimate();
}
template <typename Scalar>
Estimate estimate_of(const PackedQuadratureBatch<Scalar>& batch, std::size_t i) {
  return batch.estimate(i);
}

/// The filtered states (size, 3) and covariances (size, 3, 3).
template <typename Trackers>
py::tuple estimates(const Trackers& batch) {
  const TrackerArithmetic arithmetic;
  Array state({batch.size(), std::size_t{3}});
  Array covariance({batch.size(), std::size_t{3}, std::size_t{3}});
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const Estimate estimate = estimate_of(batch, i);
    const auto values = values_of(estimate);
    std::copy(values.begin(), values.end(), state.mutable_data(static_cast<py::ssize_t>(i), 0));
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
        covariance.mutable_data(static_cast<py::ssize_t>(i), 0, 0)) = estimate.covariance.matrix();
  }
  return py::make_tuple(state, covariance);
}

template <typename Scalar>
void bind_packed_batch(py::module_& module, const char* name) {
  using Packed = PackedQuadratureBatch<Scalar>;
  py::class_<Packed>(module, name)
      .def(py::init<const Array&, const Array&, const Array&>())
      .def("__len__", &Packed::size)
      .def("__copy__", [](const Packed& batch) { return Packed(batch); })
      .def("run", &Packed::run, py::arg("samples"), py::arg("threads"), py::arg("instructions") = "")
      .def("estimates", &estimates<Packed>);
}

}  // namespace

void bind_extended_kalman_filters(py::module_& module) {
  bind_batch(module, "QuadratureBatch", quadrature_trackers)
      .def("estimates", &estimates<Batch<QuadratureTracker>>);
  bind_batch(module, "SingleChannelBatch", single_channel_trackers)
      .def("estimates", &estimates<Batch<SingleChannelTracker>>);
  bind_packed_batch<double>(module, "PackedQuadratureBatch");
  bind_packed_batch<float>(module, "SinglePackedQuadratureBatch");
  module.def("instruction_sets", &instruction_sets);
  py::register_exception<trackers::ZeroInnovationVariance>(module, "ZeroInnovationVariance",
                                                           PyExc_ArithmeticError);
}

}  // namespace veritrack::python
