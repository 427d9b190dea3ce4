// The numbers of a set of errors as Coq's certificate of ekf/guarantee.v, and their promise.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "analysis/quadrature/true_phase/ellipsoid_search.hpp"
#include "analysis/quadrature/true_phase/steady_bounds.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/start_covariance.hpp"

namespace veritrack::certificates::coq {

/// The files of certificates/coq/ekf/ as modules of one file.
[[nodiscard]] std::string ekf_parts();

/// The question, in the decimals of the design file.
struct EkfTexts {
  std::string q1, q2, r, noise, slew, amplitude_error, phase_error, frequency_error;
  StartCovarianceText::Entries lowest, highest;
  std::array<std::string, 2> multiples;
};

[[nodiscard]] EkfTexts ekf_texts(const QuadratureEkfTables& tables, const StartCovarianceText& start);
[[nodiscard]] quadrature::EllipsoidQuestion question_of(const EkfTexts& texts);

/// The numbers of the theorems, as decimals.
struct EkfPromises {
  std::string error_bound;  ///< rad/sample, at every sample
  long settled_after = 0;   ///< samples
  std::string settled_bound;
  std::string ultimate_level;
};

[[nodiscard]] EkfPromises promises_of(const quadrature::EllipsoidQuestion& question,
                                      const quadrature::ErrorEllipsoid& set);

/// The definition `name`, of type certificate, and the lemma `name`_is_checked.
[[nodiscard]] std::string certificate_text(const std::string& name, const EkfTexts& texts,
                                           const quadrature::CoveredEllipsoid& found,
                                           const EkfPromises& promises);

/// The definition `name`, of type steady_numbers, and the lemma `name`_are_checked about that certificate.
[[nodiscard]] std::string steady_text(const std::string& name, const std::string& certificate,
                                      const quadrature::SteadyBounds& bounds);

/// The upper triangle of a symmetric matrix, row by row, each entry written by `write`.
template <typename Write>
[[nodiscard]] std::string upper_triangle(const StartCovarianceText::Entries& m, Write write) {
  std::string result;
  for (std::size_t i = 0; i < m.size(); ++i) {
    for (std::size_t j = i; j < m.size(); ++j) {
      result += (result.empty() ? "" : " ") + write(m.at(i).at(j));
    }
  }
  return result;
}

}  // namespace veritrack::certificates::coq
