#include "reports/regulator/regulator_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "certificates/regulator/regulator.hpp"
#include "certificates/regulator/regulator_simulation.hpp"
#include "reports/gnuplot.hpp"
#include "reports/line_styles.hpp"

namespace veritrack::reports {

namespace {

using certificates::ClosedLoopRun;

constexpr std::size_t kMostPoints = 250;

/// The largest of the runs' values in stretches of samples, of which so many are drawn.
FigureTable table_of_runs(const std::vector<ClosedLoopRun>& runs) {
  const std::size_t samples = runs.front().output.size();
  const std::size_t stretch = (samples + kMostPoints - 1) / kMostPoints;
  FigureTable table("runs", {"frequency of the disturbance at the start [rad/sample]", "sample",
                             "length of the output", "length of the input"});
  for (const ClosedLoopRun& run : runs) {
    for (std::size_t k = 0; k < samples; k += stretch) {
      const auto from = static_cast<std::ptrdiff_t>(k);
      const auto to = static_cast<std::ptrdiff_t>(std::min(samples, k + stretch));
      table.add({run.frequency, static_cast<double>(k),
                 *std::max_element(run.output.begin() + from, run.output.begin() + to),
                 *std::max_element(run.input.begin() + from, run.input.begin() + to)});
    }
    table.next_index();
  }
  return table;
}

/// The proved bound of the output: at every sample, from some sample on.
FigureTable table_of_bounds(const theorems::Derivation& found, double samples) {
  FigureTable table("bounds", {"sample", "proved bound of the output"});
  const double ever = find_quantity(found, "output_bound").value.upper();
  const theorems::Quantity* settling = theorems::applicable_quantity(found, "settling_samples");
  const theorems::Quantity* settled = theorems::applicable_quantity(found, "settled_output");
  table.add({0.0, ever});
  const bool is_seen = settling != nullptr && settled != nullptr && settling->value.upper() < samples;
  const double end = is_seen ? settling->value.upper() : samples;
  table.add({end, ever});
  if (is_seen) {
    table.add({end, std::min(ever, settled->value.upper())});
    table.add({samples, std::min(ever, settled->value.upper())});
  }
  return table;
}

}  // namespace

std::vector<Figure> draw_regulator_figures(const certificates::Certificate& certificate) {
  const theorems::Derivation& found = certificate.derivations.back();
  const std::vector<ClosedLoopRun> runs = certificates::simulate_closed_loop(certificate);
  if (found.verdict != rigor::Verdict::proved || runs.empty()) {
    return {};
  }
  const auto samples = static_cast<double>(runs.front().output.size());
  const double amplitude = certificates::regulator_particulars(certificate).promise.amplitude.nearest;
  FigureTable of_runs = table_of_runs(runs);
  FigureTable bounds = table_of_bounds(found, samples);
  const theorems::Quantity* ultimate = theorems::applicable_quantity(found, "ultimate_output");
  std::string script = gnuplot_style(400) + "set xlabel 'sample k'\nset ylabel 'output, its units'\n" +
                       "set logscale y\nset format y '%g'\n" +
                       fmt::format("set xrange [0:{:.6g}]\n", samples) + of_runs.block() + bounds.block();
  script += fmt::format("plot {:.9g} with lines {} title 'without a regulator (amplitude)'", amplitude,
                        line::kSignal);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    script += fmt::format(", $runs index {} using 2:3 with lines {}{}", i, line::kSimulated,
                          i == 0 ? " title 'simulated'" : " notitle");
  }
  script += fmt::format(", $bounds using 1:2 with lines {} title 'proved'", line::kCertified);
  if (ultimate != nullptr) {
    script += fmt::format(", {:.9g} with lines {} title 'proved, in the long run'", ultimate->value.upper(),
                          line::kLongRun);
  }
  std::vector<FigureTable> data;
  data.push_back(std::move(of_runs));
  data.push_back(std::move(bounds));
  return {{"output.svg",
           "Length of the output in three simulated closed loops (thin), the largest in each stretch of "
           "samples, below "
           "what is proved at every sample and from some sample on (bold) and in the long run (dash-dotted), "
           "logarithmic; the disturbance has the amplitude of the broad line. The simulations prove nothing.",
           script + "\n", "Output of the closed loop, simulated, below the proved bounds", std::move(data)}};
}

}  // namespace veritrack::reports
