#include "certificates/sets/markdown_assumptions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

namespace {

using markdown::math;

/// The unit of numbers as they are written, and their values in the other one, rounded outward.
std::string in_both_units(std::initializer_list<Number> numbers, const FrequencyUnits& units) {
  const bool in_hertz = numbers.begin()->in_hertz;
  if (!units.has_hertz()) {
    return "rad/sample";
  }
  std::string others;
  for (const Number& number : numbers) {
    others += others.empty() ? "" : " to ";
    others += rigor::to_decimal(in_hertz ? number.value : units.in_hertz(number.value), 4);
  }
  return in_hertz ? others + " rad/sample" : fmt::format("rad/sample, {} Hz", others);
}
std::string slew_in_both_units(const Number& slew, const FrequencyUnits& units) {
  std::string own = "rad/sample per sample";
  if (!units.has_hertz() || slew.value == rigor::Interval(0.0)) {
    return own;
  }
  return slew.in_hertz ? fmt::format("{} {}", rigor::to_decimal(slew.value, 4), own)
                       : units.slew(slew.value).substr(units.slew(slew.value).find(own));
}

std::string rows_text(const CovarianceArray& covariance) {
  std::string text;
  for (const auto& row : covariance) {
    text += fmt::format(" `[{}, {}, {}]`", row[0].text, row[1].text, row[2].text);
  }
  return text;
}

std::string covariance_text(const Assumptions& assume, const std::string& found) {
  const std::string rows = "in the frame of the estimated phase, row by row:";
  if (const auto& range = assume.covariance_range) {
    return fmt::format("every one {} from{} to{}", rows, rows_text((*range)[0]), rows_text((*range)[1]));
  }
  if (const auto& multiples = assume.covariance_multiples) {
    return fmt::format(
        "every one from `{}` to `{}` times the matrix M of the guarantee, in the frame of the estimated "
        "phase",
        (*multiples)[0].text, (*multiples)[1].text);
  }
  return assume.initial_covariance ? rows + rows_text(*assume.initial_covariance)
         : !found.empty()          ? markdown::escaped(found)
                                   : "that of the guarantee, next to or below the filter's steady state";
}

/// The largest frequency errors along the run and over its second half; empty without a run.
std::optional<std::pair<double, double>> largest_errors(const theorems::Trajectory& run) {
  if (run.empty()) {
    return std::nullopt;
  }
  std::pair<double, double> largest{0.0, 0.0};
  for (std::size_t k = 0; k < run.size(); ++k) {
    const double error = std::fabs(run[k].filtered_state[2] - run[k].true_state[2]);
    largest.first = std::max(largest.first, error);
    largest.second = 2 * k >= run.size() ? std::max(largest.second, error) : largest.second;
  }
  return largest;
}

}  // namespace

std::string assumptions_section(const Assumptions& assume, const std::string& covariance) {
  const auto row = [](const std::string& what, const std::string& relation, const std::string& value,
                      const std::string& unit) {
    return std::vector<std::string>{what, relation.empty() ? value : math(relation) + " " + value, unit};
  };
  const auto code = [](const Number& number) { return "`" + number.text + "`"; };
  const FrequencyUnits units(assume.sample_rate);
  std::string text = "## Assumptions on the signal and the start\n\n";
  std::vector<std::vector<std::string>> rows{
      row("amplitude of the signal", "A =", code(assume.amplitude), "signal units"),
      row(assume.gaussian ? "frequency at the start, within" : "frequency, always within", "",
          fmt::format("[{}, {}]", code(assume.frequency[0]), code(assume.frequency[1])),
          in_both_units({assume.frequency[0], assume.frequency[1]}, units))};
  if (assume.sample_rate) {
    rows.insert(rows.begin() + 1, row("samples per second", "f_s =", code(*assume.sample_rate), "Hz"));
  }
  if (const auto& gaussian = assume.gaussian) {
    rows.push_back(gaussian->snr_db
                       ? row("measurement noise, independent Gaussian: signal-to-noise ratio",
                             "A^2/(2\\sigma^2) =", code(*gaussian->snr_db), "dB")
                       : row("measurement noise, independent Gaussian: deviation in each channel",
                             "\\sigma =", code(*gaussian->deviation), "signal units"));
    rows.push_back(assume.frequency_walk ? row("deviation of the frequency's independent Gaussian steps",
                                               "w =", code(*assume.frequency_walk),
                                               in_both_units({*assume.frequency_walk}, units))
                                         : row("frequency", "", "constant", ""));
    rows.push_back(row("number of samples", "N =", code(assume.samples.value()), "samples"));
  } else {
    rows.push_back(row("measurement noise, every sample", "|v(k)| \\le", code(assume.noise), "signal units"));
    rows.push_back(row("change of frequency, every sample", "|\\omega(k+1) - \\omega(k)| \\le",
                       code(assume.slew), slew_in_both_units(assume.slew, units)));
  }
  for (auto& start : std::vector<std::vector<std::string>>{
           row("error of frequency at the start", "|\\hat x_3(0) - \\omega(0)| \\le",
               code(assume.initial_frequency_error), in_both_units({assume.initial_frequency_error}, units)),
           row("error of phase at the start", "\\le", code(assume.initial_phase_error), "rad"),
           row("error of amplitude at the start", "\\le", code(assume.initial_amplitude_error),
               "signal units"),
           row("covariance at the start", "P(0|0):", covariance_text(assume, covariance),
               "signal units² (the first two rows and columns), (rad/sample)² (the last entry)")}) {
    rows.push_back(std::move(start));
  }
  text += markdown::table({"Assumption", "Value", "Unit"}, rows);
  return text +
         "\nThe decimals in these tables are exact: every computation covers both the decimal and the double "
         "nearest to it, with which the filter runs.\n\n";
}

std::string simulated_run_section(const Certificate& certificate, const SimulationSettings& run,
                                  const MarkdownOptions& options) {
  if (options.figures.empty()) {
    return "";
  }
  std::string text = "## The simulated run\n\n";
  text += fmt::format(
      "The double-precision tracker on the signal `{}`, {} samples, seed {}, started with the largest "
      "assumed start errors. A simulation proves nothing; it is for comparison with the bounds.\n\n",
      run.signal, run.samples, run.seed);
  if (const auto error = largest_errors(certificate.simulation.trajectory)) {
    text += fmt::format(
        "Its frequency error is at most ≈ {:.3g} rad/sample, and ≈ {:.3g} rad/sample over its second "
        "half.\n\n",
        error->first, error->second);
  }
  for (const std::string& note : certificate.simulation.notes) {
    text += note + "\n\n";
  }
  for (const FigureReference& figure : options.figures) {
    text += picture(figure);
  }
  return text;
}

}  // namespace veritrack::certificates
