#include "reports/reproductions/vibration_report.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <iterator>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "analysis/experiments/repeated_runs.hpp"
#include "analysis/experiments/vibration_runs.hpp"
#include "certificates/document/markdown_text.hpp"
#include "reports/reproductions/line_panels.hpp"
#include "reports/reproductions/vibration_printed.hpp"
#include "trackers/regulator/self_tuning_regulator.hpp"

namespace veritrack::reports {

namespace {

using experiments::Estimator;
using experiments::FirstGuess;
using experiments::VibrationOrder;
using experiments::VibrationStart;
using Complex = std::complex<double>;

constexpr Conditions kStartUnpublished{Conditions::Kind::chosen, "e₋₁, e₋₂, θ₀ and P₋₁ are unpublished"};
constexpr Conditions kLimitUnpublished{Conditions::Kind::chosen, "e₋₁, e₋₂, θ₀, P₋₁ and Λ are unpublished"};
constexpr int kEarly = 250;
constexpr int kLate = 10000;
constexpr int kMany = 2000;  // samples after which a limit is read
constexpr int kOutputBy = 500;
constexpr double kFourDigits = 1e-4;
constexpr double kMonitorLimit = 1e9;  // Lambda
constexpr double kSmallLimit = 1e3;

/// The start of the figures: nothing known.
VibrationStart start_drawn(VibrationOrder order) {
  VibrationStart start{1.0, 0.5, 10.0, experiments::ideal_parameters(order)};
  start.parameters.setZero();
  start.parameters(start.parameters.size() / 2) = 2.0;
  return start;
}

Eigen::VectorXd ideal() {
  return experiments::ideal_parameters(VibrationOrder::three);
}

Eigen::VectorXd table_5_2() {
  Eigen::VectorXd result(10);
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    result(i) = printed::kTable52Numbers.at(static_cast<std::size_t>(i)).value();
  }
  return result;
}

Eigen::VectorXd table_5_1() {
  Eigen::VectorXd result(6);
  result << printed::kNumerator51[0].value(), printed::kNumerator51[1].value(),
      printed::kNumerator51[2].value(), printed::kLeading51, printed::kDenominator51[0].value(),
      printed::kDenominator51[1].value();
  return result;
}

/// sum c_i z^-i at z = e^{i omega}.
Complex polynomial(const Eigen::VectorXd& coefficients, double frequency) {
  const Complex back = std::polar(1.0, -frequency);
  Complex power = 1.0;
  Complex sum = 0.0;
  for (const double coefficient : coefficients) {
    sum += coefficient * power;
    power *= back;
  }
  return sum;
}

/// N / D of the controller -(c - a) / b, without the sign: as the thesis draws it.
Complex response(const Eigen::VectorXd& parameters, double frequency) {
  const Eigen::Index order = parameters.size() / 2;
  return polynomial(parameters.head(order), frequency) / polynomial(parameters.tail(order), frequency);
}

/// The numerator at the vibration over the rest of the denominator, D = (1 - 2 cos z^-1 + z^-2) times it.
Complex residue(const Eigen::VectorXd& parameters) {
  const Eigen::Index order = parameters.size() / 2;
  std::vector<double> rest(parameters.data() + order, parameters.data() + 2 * order);
  const double twice = 2.0 * std::cos(experiments::kVibration);
  for (std::size_t i = 0; i + 2 < rest.size(); ++i) {
    rest[i + 1] += twice * rest[i];
    rest[i + 2] -= rest[i];
  }
  const Eigen::VectorXd quotient = Eigen::Map<Eigen::VectorXd>(rest.data(), order - 2);
  return polynomial(parameters.head(order), experiments::kVibration) /
         polynomial(quotient, experiments::kVibration);
}

/// The roots in z of b_0 z^{n-1} + ... + b_{n-1}, the real ones first in rising order.
std::vector<Complex> poles_of(const Eigen::VectorXd& parameters) {
  const Eigen::Index order = parameters.size() / 2;
  const Eigen::VectorXd b = parameters.tail(order);
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order - 1, order - 1);
  companion.row(0) = -b.tail(order - 1).transpose() / b(0);
  companion.diagonal(-1).setOnes();
  const Eigen::VectorXcd roots = companion.eigenvalues();
  std::vector<Complex> result(roots.data(), roots.data() + roots.size());
  std::sort(result.begin(), result.end(), [](const Complex& x, const Complex& y) {
    const bool x_real = std::fabs(x.imag()) < 1e-9;
    const bool y_real = std::fabs(y.imag()) < 1e-9;
    return x_real != y_real ? x_real : std::pair(x.real(), x.imag()) < std::pair(y.real(), y.imag());
  });
  return result;
}

/// What the starts of all seeds give.
struct Study {
  std::vector<double> efra_early, monitored_early;  ///< pole errors after 250 samples, order 3
  std::vector<bool> efra_poles, monitored_poles;    ///< to four digits, after 250 and after 10000
  std::vector<Eigen::VectorXd> limit3, limit5;      ///< EFRA, nothing known
  std::vector<Eigen::VectorXd> near3, near5;        ///< EFRA, started near the ideal parameters
  std::vector<bool> small_limit_poles;              ///< as monitored_poles, with a smaller Lambda
  std::vector<bool> pole5, output5;
};

Study study_of(int runs, const ReproductionProgress& progress) {
  struct One {
    double efra_early = 0.0, monitored_early = 0.0, monitored_late = 0.0, small_limit = 0.0;
    Eigen::VectorXd limit3, limit5, near3, near5;
    double output5 = 0.0;
  };
  const auto all = experiments::repeat(runs, [&](std::uint64_t seed) {
    const auto start = [&](VibrationOrder order, FirstGuess guess) {
      return experiments::drawn_start(order, guess, seed);
    };
    const auto limit = [&](VibrationOrder order, Estimator estimator, int samples, FirstGuess guess) {
      return experiments::limiting_parameters(order, estimator, start(order, guess), samples, kMonitorLimit);
    };
    constexpr auto kThree = VibrationOrder::three;
    constexpr auto kFive = VibrationOrder::five;
    constexpr auto kNothing = FirstGuess::nothing;
    One one;
    one.efra_early = experiments::pole_error(limit(kThree, Estimator::efra, kEarly, kNothing));
    one.monitored_early = experiments::pole_error(limit(kThree, Estimator::monitored, kEarly, kNothing));
    one.monitored_late = experiments::pole_error(limit(kThree, Estimator::monitored, kLate, kNothing));
    one.small_limit = experiments::pole_error(experiments::limiting_parameters(
        kThree, Estimator::monitored, start(kThree, kNothing), kLate, kSmallLimit));
    one.limit3 = limit(kThree, Estimator::efra, kMany, kNothing);
    one.limit5 = limit(kFive, Estimator::efra, kMany, kNothing);
    one.near3 = limit(kThree, Estimator::efra, kMany, FirstGuess::near_ideal);
    one.near5 = limit(kFive, Estimator::efra, kMany, FirstGuess::near_ideal);
    one.output5 = std::fabs(
        experiments::vibration_run(kFive, Estimator::efra, start(kFive, kNothing), kOutputBy).output.back());
    return one;
  });
  constexpr double kSmallOutput = 0.01;
  Study study;
  for (const One& one : all) {
    study.efra_early.push_back(one.efra_early);
    study.monitored_early.push_back(one.monitored_early);
    study.efra_poles.push_back(one.efra_early < kFourDigits);
    study.monitored_poles.push_back(one.monitored_late < kFourDigits);
    study.small_limit_poles.push_back(one.small_limit < kFourDigits);
    study.limit3.push_back(one.limit3);
    study.limit5.push_back(one.limit5);
    study.near3.push_back(one.near3);
    study.near5.push_back(one.near5);
    study.pole5.push_back(experiments::pole_error(one.limit5) < kFourDigits);
    study.output5.push_back(one.output5 < kSmallOutput);
  }
  if (progress) {
    progress(1, 1);
  }
  return study;
}

std::vector<bool> held(const std::vector<Eigen::VectorXd>& limits, bool (*what)(const Eigen::VectorXd&)) {
  std::vector<bool> result;
  std::transform(limits.begin(), limits.end(), std::back_inserter(result), what);
  return result;
}

std::vector<double> parameter(const std::vector<Eigen::VectorXd>& limits, Eigen::Index index, bool relative) {
  std::vector<double> result;
  for (const Eigen::VectorXd& limit : limits) {
    const double scale = relative ? limit(limit.size() / 2) / printed::kLeading51 : 1.0;
    result.push_back(limit(index) / scale);
  }
  return result;
}

std::string complex_words(const Complex& value) {
  return fmt::format("{:.4f}{:+.4f}j", value.real(), value.imag());
}

/// Whether two complex numbers agree to 1 %.
Outcome matching(const Complex& ideal_value, const Complex& limit) {
  return decided(
      std::abs(limit - ideal_value) <= 0.01 * std::abs(ideal_value),
      fmt::format("{} against {} of the ideal one", complex_words(limit), complex_words(ideal_value)));
}

void add_exact(std::vector<Entry>& entries) {
  const auto bounds = trackers::efra_bounds(trackers::thesis_efra_design<double>());
  entries.push_back(entry_of(printed::kEfraLower, same_number(printed::kEfraLower, bounds.lower)));
  entries.push_back(entry_of(printed::kEfraUpper, same_number(printed::kEfraUpper, bounds.upper)));
  const std::vector<Complex> poles = poles_of(table_5_2());
  const auto pair =
      std::find_if(poles.begin(), poles.end(), [](const Complex& pole) { return pole.imag() > 0.1; });
  const std::array<double, 4> found{poles.at(0).real(), poles.at(1).real(), pair->real(), pair->imag()};
  for (std::size_t i = 0; i < found.size(); ++i) {
    entries.push_back(entry_of(printed::kPoles52.at(i), same_number(printed::kPoles52.at(i), found.at(i))));
  }
  entries.push_back(entry_of(printed::kMatch51, matching(residue(ideal()), residue(table_5_1()))));
  entries.push_back(entry_of(printed::kMatch52, matching(residue(ideal()), residue(table_5_2()))));
}

void add_sampled(std::vector<Entry>& entries, const Study& study) {
  const auto add = [&](const PrintedSentence& sentence, Claimed claimed, const std::vector<bool>& what,
                       const Conditions& conditions) {
    entries.push_back(entry_of(sentence, share_of_runs(claimed, what), conditions));
  };
  add(printed::kEfraPoles, Claimed::usually, study.efra_poles, kStartUnpublished);
  add(printed::kMonitoredPoles, Claimed::sometimes, study.monitored_poles, kLimitUnpublished);
  entries.push_back(entry_of(printed::kMonitoredSlow, smaller_mean(study.efra_early, study.monitored_early),
                             kLimitUnpublished));
  add(printed::kDenominatorMultiple, Claimed::usually,
      held(study.limit3,
           [](const Eigen::VectorXd& limit) { return experiments::pole_error(limit) < kFourDigits; }),
      kStartUnpublished);
  add(printed::kNumeratorNoMultiple, Claimed::usually,
      held(study.limit3,
           [](const Eigen::VectorXd& limit) {
             const Eigen::VectorXd scaled = limit * (printed::kLeading51 / limit(3));
             return (scaled - ideal()).head(3).norm() > 0.01 * ideal().head(3).norm();
           }),
      kStartUnpublished);
  for (std::size_t i = 0; i < printed::kNumerator51.size(); ++i) {
    const PrintedNumber& number = printed::kNumerator51.at(i);
    entries.push_back(entry_of(number,
                               among_runs(number, parameter(study.near3, static_cast<Eigen::Index>(i), true)),
                               kStartUnpublished));
  }
  for (std::size_t i = 0; i < printed::kDenominator51.size(); ++i) {
    const PrintedNumber& number = printed::kDenominator51.at(i);
    entries.push_back(
        entry_of(number, among_runs(number, parameter(study.near3, static_cast<Eigen::Index>(4 + i), true)),
                 kStartUnpublished));
  }
  for (std::size_t i = 0; i < printed::kTable52Numbers.size(); ++i) {
    const PrintedNumber& number = printed::kTable52Numbers.at(i);
    entries.push_back(
        entry_of(number, among_runs(number, parameter(study.near5, static_cast<Eigen::Index>(i), false)),
                 kStartUnpublished));
  }
  add(printed::kPole52, Claimed::usually, study.pole5, kStartUnpublished);
  add(printed::kOutput52, Claimed::usually, study.output5, kStartUnpublished);
  add(printed::kSurplus52, Claimed::usually,
      held(study.limit5,
           [](const Eigen::VectorXd& limit) {
             const Eigen::Vector4d surplus(limit(3), limit(4), limit(8), limit(9));
             return surplus.cwiseAbs().maxCoeff() > 0.01;
           }),
      kStartUnpublished);
}

std::vector<double> counted(std::size_t size) {
  std::vector<double> result(size);
  std::iota(result.begin(), result.end(), 0.0);
  return result;
}

const std::array<const char*, 5> kParameterStyles{
    "lines lw 1.6 lc rgb '#000000'", "lines lw 1.6 dt '-' lc rgb '#000000'",
    "lines lw 1.6 dt '.' lc rgb '#000000'", "lines lw 1.6 lc rgb '#888888'",
    "lines lw 1.6 dt '-' lc rgb '#888888'"};

/// Some of the parameters along a run.
LinePanel parameter_panel(std::string title, const experiments::VibrationRun& run, Eigen::Index first,
                          const std::vector<std::string>& names,
                          std::string settings = "set yrange [*:*]\nset ytics 0.5\n") {
  LinePanel panel{std::move(title), "parameter", {}, std::move(settings)};
  for (std::size_t i = 0; i < names.size(); ++i) {
    PanelLine line{names[i], counted(run.parameters.size()), {}, kParameterStyles.at(i)};
    for (const Eigen::VectorXd& theta : run.parameters) {
      line.y.push_back(theta(first + static_cast<Eigen::Index>(i)));
    }
    panel.lines.push_back(std::move(line));
  }
  return panel;
}

Figure draw_example_1() {
  constexpr int kShown = 300;
  const auto efra = experiments::vibration_run(VibrationOrder::three, Estimator::efra,
                                               start_drawn(VibrationOrder::three), kShown);
  const auto monitored = experiments::vibration_run(
      VibrationOrder::three, Estimator::monitored, start_drawn(VibrationOrder::three), kShown, kMonitorLimit);
  const auto output = [](std::string title, const experiments::VibrationRun& run) {
    return LinePanel{std::move(title),
                     "output",
                     {{"y", counted(run.output.size()), run.output}},
                     "set yrange [-5:5]\nset ytics 2.5\n"};
  };
  return draw_line_panels(
      "example-1.svg", "Example 1: outputs and parameters", "sample k",
      {output("Figure 5.3: condition number monitoring", monitored), output("Figure 5.3: EFRA", efra),
       parameter_panel("Figure 5.4: numerator, EFRA", efra, 0, {"c1 − a1", "c2 − a2", "c3 − a3"}),
       parameter_panel("Figure 5.5: denominator, EFRA", efra, 3, {"b0", "b1", "b2"})});
}

Figure draw_example_2() {
  constexpr int kShown = 500;
  const auto efra = experiments::vibration_run(VibrationOrder::five, Estimator::efra,
                                               start_drawn(VibrationOrder::five), kShown);
  return draw_line_panels(
      "example-2.svg", "Example 2: parameters and output", "sample k",
      {parameter_panel("Figure 5.8: numerator", efra, 0,
                       {"c1 − a1", "c2 − a2", "c3 − a3", "c4 − a4", "c5 − a5"}),
       parameter_panel("Figure 5.8: denominator", efra, 5, {"b0", "b1", "b2", "b3", "b4"}),
       {"Figure 5.9: output",
        "output",
        {{"y", counted(efra.output.size()), efra.output}},
        "set yrange [-5:5]\nset ytics 2.5\n"}});
}

Figure draw_responses() {
  constexpr int kPoints = 400;
  const auto panels_of = [](std::vector<LinePanel>& panels, int figure, const Eigen::VectorXd& table) {
    LinePanel magnitude{fmt::format("Figure 5.{}: magnitude", figure), "dB", {}, "set yrange [-30:40]\n"};
    LinePanel phase{fmt::format("Figure 5.{}: phase", figure + 1), "degrees", {}, "set yrange [-200:200]\n"};
    const std::array<std::pair<const char*, Eigen::VectorXd>, 2> both{
        {{"ideal", ideal()}, {"limit, as printed", table}}};
    for (std::size_t i = 0; i < both.size(); ++i) {
      PanelLine gain{
          both.at(i).first, {}, {}, i == 0 ? "lines lw 4 lc rgb '#bbbbbb'" : "lines lw 1.4 lc rgb '#000000'"};
      PanelLine angle = gain;
      for (int k = 1; k < kPoints; ++k) {
        const double frequency = std::numbers::pi * k / kPoints;
        const Complex value = response(both.at(i).second, frequency);
        gain.x.push_back(frequency);
        angle.x.push_back(frequency);
        gain.y.push_back(20.0 * std::log10(std::abs(value)));
        angle.y.push_back(180.0 / std::numbers::pi * std::arg(value));
      }
      magnitude.lines.push_back(std::move(gain));
      phase.lines.push_back(std::move(angle));
    }
    panels.push_back(std::move(magnitude));
    panels.push_back(std::move(phase));
  };
  std::vector<LinePanel> panels;
  panels_of(panels, 6, table_5_1());
  panels_of(panels, 10, table_5_2());
  return draw_line_panels("responses.svg",
                          "Frequency responses of the ideal controller and of the printed limits",
                          "frequency [rad/sample]", panels);
}

std::string vibration_document(const std::vector<Entry>& entries, std::ptrdiff_t poles_with_small_limit,
                               int runs) {
  std::string text = "# Chapter 5 of La Scala's thesis: the self-tuning regulator against vibration\n\n";
  const std::string warning = too_few_runs(entries, runs);
  text += warning.empty() ? "" : "*" + warning + "*\n\n";
  const double gamma = 1.0 / 0.95 - 1.0;
  const std::vector<Complex> poles = poles_of(table_5_2());
  text += "**" + count_sentence(entries) + "** ";
  text += fmt::format(
      "The structure of both examples comes out for nearly every start: the regulator finds the pole of the "
      "vibration, the denominator of order 3 becomes a multiple of the ideal one, "
      "the numerator does not, and the surplus parameters of order 5 do not vanish. The numbers of the "
      "limits depend on starts that are not printed. Three things in print are wrong. (1) The upper bound "
      "10.1 is that of γ = 1 − λ = 0.05; with γ = (1 − λ)/λ = {:.4f}, as the thesis defines it, it is "
      "{:.2f}. (2) The \"poles\" −3.2232 and 2.2085 are in z⁻¹: those of the "
      "controller are their reciprocals, {:.4f} and {:.4f}, inside the unit circle. (3) At ω the limits do "
      "not match the ideal controller: they share its pole, where both are infinite, and Figures 5.6 and 5.7 "
      "show no more; the residues differ. They need not be the same: where the output is zero, only the pole "
      "matters.\n\n",
      gamma, trackers::efra_bounds(trackers::thesis_efra_design<double>()).upper, poles.at(0).real(),
      poles.at(1).real());
  text += fmt::format(
      "## Printed and ours\n\n{} starts: e₋₁ and e₋₂ normal with deviation 1, θ₀ zero but for b₀, which is "
      "uniform in [1, 4], P₋₁ = p I with p from 0.1 to 10, uniform in its logarithm (seeds from 1 on; 64-bit "
      "Mersenne twister, Karney's normal deviates). Limits are read after {} samples. For the monitored "
      "estimator r₋₁ = 1 and Λ = 10⁹: with Λ = 1000, {} of {} starts have the poles to four digits after {} "
      "samples. \"The poles are\": the "
      "denominator at the vibration is below 10⁻⁴ of the sum of its coefficients. A printed number of a "
      "limit agrees when it lies among those of starts whose θ₀ is the ideal one with a normal error of "
      "deviation "
      "0.5 in each entry.\n\n{}",
      runs, kMany, poles_with_small_limit, runs, kLate, entry_table(entries));
  text +=
      "\n## The figures\n\n![Four panels: the output decays slowly with one estimator and fast with the "
      "other, and the parameters settle](figures/example-1.svg)\n\n*Figures 5.3 to 5.5: Example 1 with "
      "e₋₁ = 1, e₋₂ = 0.5, b₀ = 2, P₋₁ = 10 I.*\n\n![Three panels: parameters and output for order "
      "5](figures/example-2.svg)\n\n*Figures 5.8 and 5.9: Example 2, the same start.*\n\n"
      "![Four panels: magnitude and phase of the ideal and the limiting "
      "controllers](figures/responses.svg)\n\n*Figures 5.6, 5.7, 5.10 and 5.11: the ideal controller (broad "
      "grey) and the limits of Tables 5.1 and 5.2 as "
      "printed (thin black). They have the pole at π/6 = 0.52 rad/sample in common.*\n\n"
      "Simulated with `trackers/regulator` in double precision; simulations prove nothing. What is computed "
      "from printed numbers alone (bounds, poles, residues) is rounded double precision, too.\n";
  return text;
}

}  // namespace

Findings reproduce_tables_5(int runs, const ReproductionProgress& progress) {
  const Study study = study_of(runs, progress);
  Findings result;
  add_exact(result.entries);
  add_sampled(result.entries, study);
  result.markdown = vibration_document(
      result.entries, std::count(study.small_limit_poles.begin(), study.small_limit_poles.end(), true), runs);
  result.figures = {draw_example_1(), draw_example_2(), draw_responses()};
  return result;
}

}  // namespace veritrack::reports
