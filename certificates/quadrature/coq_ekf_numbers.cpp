#include "certificates/quadrature/coq_ekf_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "analysis/rigor/decimal.hpp"
#include "certificates/document/coq_numbers.hpp"
#include "certificates/document/coq_parts.hpp"

namespace veritrack::certificates::coq {

namespace {

using quadrature::CellTree;
using quadrature::EllipsoidQuestion;
using quadrature::ErrorEllipsoid;

constexpr std::array kParts{"filter", "frame", "error", "order",     "induction", "positive",
                            "leaf",   "cell",  "cover", "guarantee", "steady"};

/// A double as a number of type Q, exactly.
std::string exact(double x) {
  return x == 0.0 ? "0" : fmt::format("({:a})", x);
}

std::string exact(const Eigen::Matrix3d& m) {
  return fmt::format("(Build_symmetric_Q {} {} {} {} {} {})", exact(m(0, 0)), exact(m(0, 1)), exact(m(0, 2)),
                     exact(m(1, 1)), exact(m(1, 2)), exact(m(2, 2)));
}

std::string exact(const Eigen::Matrix<double, 3, 2>& gain) {
  std::string result;
  for (Eigen::Index i = 0; i < 3; ++i) {
    result += fmt::format(" {} {}", exact(gain(i, 0)), exact(gain(i, 1)));
  }
  return result;
}

std::string exact(const CellTree& tree) {
  constexpr std::array kAxes{"e1", "e2", "nu"};
  switch (tree.kind) {
    case CellTree::Kind::outside:
      return "Outside";
    case CellTree::Kind::checked: {
      const quadrature::CellNumbers& cell = tree.numbers;
      return fmt::format("(Checked (Build_leaf {} {}{} {} {}))", exact(cell.lowest), exact(cell.highest),
                         exact(cell.gain), exact(cell.lambda), exact(cell.mu));
    }
    case CellTree::Kind::cut:
      break;
  }
  return fmt::format("(Cut_{} {}\n  {}\n  {})", kAxes.at(static_cast<std::size_t>(tree.axis)), exact(tree.at),
                     exact(*tree.below), exact(*tree.above));
}

double number(const std::string& text) {
  std::string plain = text;
  std::erase(plain, '_');
  return rigor::midpoint(rigor::parse_decimal(plain));
}

Eigen::Matrix3d matrix_of(const StartCovarianceText::Entries& entries, double multiple) {
  Eigen::Matrix3d result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          multiple * number(entries.at(i).at(j));
    }
  }
  return result;
}

std::string rounded_up(double x) {
  constexpr int kDigits = 5;
  constexpr double kForArithmetic = 1.0 + 1e-9;
  return rigor::to_decimal(x * kForArithmetic, kDigits, rigor::Direction::up);
}

}  // namespace

// The Coq libraries that the files require stand before each module.
std::string ekf_parts() {
  constexpr std::string_view kOwn = "From Veritrack Require Import ";
  constexpr std::string_view kRequire = " Require Import ";
  std::string result;
  for (const char* name : kParts) {
    std::istringstream text{std::string(text_for_all_designs(fmt::format("ekf/{}", name)))};
    std::string required;
    std::string body;
    for (std::string line; std::getline(text, line);) {
      const std::size_t at = line.starts_with("From ") ? line.find(kRequire) : std::string::npos;
      if (at == std::string::npos) {
        body += line + "\n";
        continue;
      }
      const std::string modules = line.substr(at + kRequire.size());
      body += fmt::format("Import {}\n", modules);
      if (!line.starts_with(kOwn)) {
        required += fmt::format("{} Require {}\n", line.substr(0, at), modules);
      }
    }
    result += fmt::format("\n{1}Module {0}.\n{2}End {0}.\n", name, required, body);
  }
  return result;
}

EkfTexts ekf_texts(const QuadratureEkfTables& tables, const StartCovarianceText& start) {
  const Assumptions& assume = tables.assume;
  const std::array<std::string, 2> ours{"0.99", "1.01"};
  return {tables.design.q1.text,
          tables.design.q2.text,
          tables.design.r.text,
          assume.noise.text,
          assume.slew.text,
          assume.initial_amplitude_error.text,
          assume.initial_phase_error.text,
          assume.initial_frequency_error.text,
          start.entries,
          start.highest.value_or(start.entries),
          start.multiples.value_or(start.is_given ? std::array<std::string, 2>{"1", "1"} : ours)};
}

EllipsoidQuestion question_of(const EkfTexts& texts) {
  EllipsoidQuestion question;
  question.design = {number(texts.q1), number(texts.q2), number(texts.r), 0.0};
  question.noise = number(texts.noise);
  question.slew = number(texts.slew);
  question.amplitude_error = number(texts.amplitude_error);
  question.phase_error = number(texts.phase_error);
  question.frequency_error = number(texts.frequency_error);
  question.start_lowest = matrix_of(texts.lowest, number(texts.multiples[0]));
  question.start_highest = matrix_of(texts.highest, number(texts.multiples[1]));
  return question;
}

EkfPromises promises_of(const EllipsoidQuestion& question, const ErrorEllipsoid& set) {
  constexpr double kWider = 1.00001;
  constexpr double kAboveUltimate = 0.02;
  constexpr double kMostSamples = 1000.0;
  const double bound = kWider * std::sqrt(set.inverse(2, 2));
  const std::string level = rounded_up(quadrature::ultimate_level(question, set));
  const double u = number(level);
  const double samples =
      std::clamp(std::ceil(std::log(kAboveUltimate * u) / std::log(set.kappa2)), 0.0, kMostSamples);
  const double remaining = std::pow(set.kappa2, samples) * (1.0 - u) + u;
  const std::string error_bound = rounded_up(bound);
  return {error_bound, static_cast<long>(samples), rounded_up(number(error_bound) * std::sqrt(remaining)),
          level};
}

std::string certificate_text(const std::string& name, const EkfTexts& texts,
                             const quadrature::CoveredEllipsoid& found, const EkfPromises& promises) {
  constexpr double kWider = 1.0001;
  const ErrorEllipsoid& set = found.set;
  const auto q = [](const std::string& text) { return fraction(text); };
  return fmt::format(
      "\nDefinition {} : certificate := {{|\n"
      "  set := {{|\n    design_q1 := {}; design_q2 := {}; design_r := {};\n    set_M := {};\n    set_N := "
      "{};\n"
      "    set_lo := {};\n    set_hi := {};\n    set_kappa2 := {}; set_noise_gain := {}; set_slew_gain := {} "
      "|}};\n"
      "  noise_bound := {}; slew_bound := {};\n"
      "  amplitude_error := {}; phase_error := {}; frequency_error := {};\n"
      "  start_lo := Build_symmetric_Q {};\n  start_hi := Build_symmetric_Q {};\n"
      "  from_multiple := {}; to_multiple := {};\n"
      "  half_width_1 := {}; half_width_2 := {}; error_bound := {};\n"
      "  ultimate_level := {}; settled_after := {}; settled_bound := {};\n  cells := {} |}}.\n"
      "Lemma {}_is_checked : check {} = true.\nProof. vm_cast_no_check (eq_refl true). Qed.\n",
      name, q(texts.q1), q(texts.q2), q(texts.r), exact(set.shape), exact(set.inverse), exact(set.lowest),
      exact(set.highest), exact(set.kappa2), exact(set.noise_gain), exact(set.slew_gain), q(texts.noise),
      q(texts.slew), q(texts.amplitude_error), q(texts.phase_error), q(texts.frequency_error),
      upper_triangle(texts.lowest, fraction), upper_triangle(texts.highest, fraction), q(texts.multiples[0]),
      q(texts.multiples[1]), exact(quadrature::stored(kWider * std::sqrt(set.inverse(0, 0)))),
      exact(quadrature::stored(kWider * std::sqrt(set.inverse(1, 1)))), q(promises.error_bound),
      q(promises.ultimate_level), promises.settled_after, q(promises.settled_bound), exact(*found.cells),
      name, name);
}

std::string steady_text(const std::string& name, const std::string& certificate,
                        const quadrature::SteadyBounds& bounds) {
  const auto leaf = [](const Eigen::Matrix<double, 3, 2>& gain) {
    return fmt::format("Build_leaf none none{} 1 1", exact(gain));
  };
  return fmt::format(
      "\nDefinition {0} : steady_numbers := {{|\n  above := {2};\n  beneath := {3};\n  least_share := {4}; "
      "least_size := {5} |}}.\n"
      "Lemma {0}_are_checked : check_steady {1} {0} = true.\nProof. vm_cast_no_check (eq_refl true). Qed.\n",
      name, certificate, leaf(bounds.gain_above), leaf(bounds.gain_beneath), exact(bounds.least_share),
      exact(bounds.least_size));
}

}  // namespace veritrack::certificates::coq
