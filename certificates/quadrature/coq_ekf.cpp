#include "certificates/quadrature/coq_ekf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <string_view>

#include "analysis/quadrature/true_phase/ellipsoid_search.hpp"
#include "analysis/rigor/decimal.hpp"
#include "certificates/document/coq_numbers.hpp"

namespace veritrack::certificates::coq {

namespace {

using quadrature::CellTree;
using quadrature::EllipsoidAim;
using quadrature::EllipsoidQuestion;
using quadrature::ErrorEllipsoid;
using rigor::Interval;

constexpr std::array kParts{"filter",   "frame", "error", "order", "induction",
                            "positive", "leaf",  "cell",  "cover", "guarantee"};

/// The files as modules of one file: what they require of Coq's libraries stands before each module.
std::string all_parts() {
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

/// A double as a number of type Q, exactly.
std::string exact(double x) {
  return x == 0.0 ? "0" : fmt::format("({:a})", x);
}

std::string exact(const Eigen::Matrix3d& m) {
  return fmt::format("(Build_symmetric_Q {} {} {} {} {} {})", exact(m(0, 0)), exact(m(0, 1)), exact(m(0, 2)),
                     exact(m(1, 1)), exact(m(1, 2)), exact(m(2, 2)));
}

std::string exact(const CellTree& tree) {
  constexpr std::array kAxes{"e1", "e2", "nu"};
  switch (tree.kind) {
    case CellTree::Kind::outside:
      return "Outside";
    case CellTree::Kind::checked: {
      const quadrature::CellNumbers& cell = tree.numbers;
      std::string gain;
      for (Eigen::Index i = 0; i < 3; ++i) {
        gain += fmt::format(" {} {}", exact(cell.gain(i, 0)), exact(cell.gain(i, 1)));
      }
      return fmt::format("(Checked (Build_leaf {} {}{} {} {}))", exact(cell.lowest), exact(cell.highest),
                         gain, exact(cell.lambda), exact(cell.mu));
    }
    case CellTree::Kind::cut:
      break;
  }
  return fmt::format("(Cut_{} {}\n  {}\n  {})", kAxes.at(static_cast<std::size_t>(tree.axis)), exact(tree.at),
                     exact(*tree.below), exact(*tree.above));
}

/// The decimals of the question.
struct Texts {
  std::string q1, q2, r, noise, slew, amplitude_error, phase_error, frequency_error;
  StartCovarianceText::Entries lowest, highest;
  std::array<std::string, 2> multiples;
};

Texts texts_of(const QuadratureEkfTables& tables, const StartCovarianceText& start) {
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

EllipsoidQuestion question_of(const Texts& texts) {
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

/// The six entries of a symmetric matrix, as numbers of type R ("/") or Q ("#").
std::string entries(const StartCovarianceText::Entries& m, std::string_view sign_between) {
  return fmt::format("{} {} {} {} {} {}", quotient(m[0][0], sign_between), quotient(m[0][1], sign_between),
                     quotient(m[0][2], sign_between), quotient(m[1][1], sign_between),
                     quotient(m[1][2], sign_between), quotient(m[2][2], sign_between));
}

std::string rounded_up(double x) {
  constexpr int kDigits = 5;
  constexpr double kForArithmetic = 1.0 + 1e-9;
  return rigor::to_decimal(x * kForArithmetic, kDigits, rigor::Direction::up);
}

/// What the theorems say, as decimals.
struct Promises {
  std::string error_bound;  ///< rad/sample, at every sample
  long settled_after = 0;   ///< samples
  std::string settled_bound;
  std::string ultimate_level;
};

Promises promises_of(const EllipsoidQuestion& question, const ErrorEllipsoid& set) {
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

std::string certificate_text(const std::string& name, const Texts& texts, const ErrorEllipsoid& set,
                             const CellTree& cells, const Promises& promises) {
  constexpr double kWider = 1.0001;
  const auto q = [](const std::string& text) { return quotient(text, "#"); };
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
      entries(texts.lowest, "#"), entries(texts.highest, "#"), q(texts.multiples[0]), q(texts.multiples[1]),
      exact(quadrature::stored(kWider * std::sqrt(set.inverse(0, 0)))),
      exact(quadrature::stored(kWider * std::sqrt(set.inverse(1, 1)))), q(promises.error_bound),
      q(promises.ultimate_level), promises.settled_after, q(promises.settled_bound), exact(cells), name,
      name);
}

/// Design and start covariance as real numbers, for the statements.
std::string definitions(const Texts& texts) {
  const auto real = [](const std::string& text) { return quotient(text, "/"); };
  return fmt::format(
      "\n(* The design, and the matrices between whose multiples the covariance at the start lies. *)\n"
      "Definition tracker : noise_model := {{| q1 := {}; q2 := {}; r := {} |}}.\n"
      "Definition lowest_start : symmetric := Symmetric {}.\nDefinition highest_start : symmetric := "
      "Symmetric {}.\n",
      real(texts.q1), real(texts.q2), real(texts.r), entries(texts.lowest, "/"), entries(texts.highest, "/"));
}

/// The theorem, for the samples that `condition` selects.
std::string proposition(const Texts& texts, const std::string& condition, const std::string& bound) {
  const auto real = [](const std::string& text) { return quotient(text, "/"); };
  return fmt::format(
      "forall (phi omega v1 v2 : nat -> R) (a psi nu : R) (m : symmetric),\n"
      "  (forall k, phi (S k) = phi k + omega k) -> (* the phase of the signal and its frequency, rad/sample "
      "*)\n"
      "  (forall k, v1 k ^ 2 + v2 k ^ 2 <= {} ^ 2) -> (* the measurement noise, relative to the amplitude "
      "*)\n"
      "  (forall k, Rabs (omega (S k) - omega k) <= {}) -> (* the slew, rad/sample per sample *)\n"
      "  Rabs a <= {} -> Rabs psi <= {} -> Rabs nu <= {} -> (* errors of the start: amplitude, phase, "
      "frequency *)\n"
      "  below (multiple {} lowest_start) m -> below m (multiple {} highest_start) -> (* P(0|0) *)\n"
      "  forall k, {}Rabs (x (run tracker (start_estimate (phi 0%nat) (omega 0%nat) a psi nu m)\n"
      "    (measurement phi v1 v2) k) 3%nat 1%nat - omega k) <= {}",
      real(texts.noise), real(texts.slew), real(texts.amplitude_error), real(texts.phase_error),
      real(texts.frequency_error), real(texts.multiples[0]), real(texts.multiples[1]), condition,
      real(bound));
}

std::string proof(const std::string& certificate, const char* which) {
  return fmt::format(
      "  intros phi omega v1 v2 a psi nu m H1 H2 H3 H4 H5 H6 H7 H8.\n"
      "  exact ({0} (check_sound {1} {1}_is_checked phi omega v1 v2 a psi nu m H1 H2 H3 H4 H5 H6 H7 H8)).",
      which, certificate);
}

}  // namespace

void prove_guarantee(Proofs& proofs, const QuadratureEkfTables& tables, const StartCovarianceText& start) {
  const Assumptions& assume = tables.assume;
  if (!tables.design.without_leak() || assume.gaussian || !(assume.amplitude.value == Interval(1.0)) ||
      assume.initial_frequency_error.in_hertz || assume.slew.in_hertz) {
    return;
  }
  const Texts texts = texts_of(tables, start);
  const EllipsoidQuestion question = question_of(texts);
  const auto for_ever = search_ellipsoid(question, EllipsoidAim::for_ever);
  const auto long_run = search_ellipsoid(question, EllipsoidAim::in_the_long_run);
  if (!for_ever || !long_run) {
    return;
  }
  const Promises always = promises_of(question, for_ever->set);
  const Promises settled = promises_of(question, long_run->set);
  proofs.write(all_parts());
  proofs.write(
      "\nModule ekf.\nImport Reals QArith filter positive leaf cover guarantee.\n"
      "Local Open Scope Q_scope.\n");
  proofs.write(certificate_text("set_for_ever", texts, for_ever->set, *for_ever->cells, always));
  proofs.write(certificate_text("set_for_the_long_run", texts, long_run->set, *long_run->cells, settled));
  proofs.write("Local Open Scope R_scope.\n" + definitions(texts));
  proofs.prove(
      "frequency_error_for_ever", proposition(texts, "", always.error_bound), proof("set_for_ever", "proj1"),
      "ekf/frequency-error-bound",
      fmt::format(
          "The recursion (2.3)-(2.9) over the real numbers, for every tone of amplitude 1 and every noise "
          "and "
          "change of the frequency within what is assumed, from every start that is assumed and every "
          "P(0|0) from {} M to {} M: the frequency error never exceeds {} rad/sample.",
          texts.multiples[0], texts.multiples[1], always.error_bound));
  proofs.prove(
      "frequency_error_in_the_long_run",
      proposition(texts, fmt::format("({} <= k)%nat -> ", settled.settled_after), settled.settled_bound),
      proof("set_for_the_long_run", "proj2"), "ekf/settling-time",
      fmt::format("With these hypotheses it never exceeds {1} rad/sample from sample {0} on.",
                  settled.settled_after, settled.settled_bound));
  proofs.write("End ekf.\nImport ekf.\n\n");
}

}  // namespace veritrack::certificates::coq
