#include "reports/kkl_observer/kkl_figures.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "analysis/kkl_observer/kkl_section_v.hpp"
#include "certificates/kkl_observer/kkl_observer.hpp"
#include "certificates/kkl_observer/kkl_observer_design.hpp"
#include "reports/gnuplot.hpp"

namespace veritrack::reports {

namespace {

using kkl_observer::EstimateSample;
using kkl_observer::SectionVRun;

/// One panel: its label, the true value, and the estimate that it shows.
struct Panel {
  std::string quantity, unit;
  double truth, low, high;
  double EstimateSample::*estimate;
};

/// A figure: what draws it, and its numbers.
struct Drawing {
  std::string script;
  std::vector<FigureTable> data;
};

/// The estimates of the panels over time; a run is an index.
FigureTable table_of_runs(const std::vector<SectionVRun>& runs, const std::vector<Panel>& panels) {
  std::vector<std::string> columns{"frequency of the disturbance [rad/s]", "time [s]"};
  for (const Panel& panel : panels) {
    columns.push_back(fmt::format("estimated {} [{}]", panel.quantity, panel.unit));
  }
  FigureTable table("runs", std::move(columns));
  for (const SectionVRun& run : runs) {
    for (const EstimateSample& sample : run.samples) {
      std::vector<FigureTable::Cell> row{run.disturbance_frequency, sample.time};
      for (const Panel& panel : panels) {
        row.emplace_back(sample.*panel.estimate);
      }
      table.add(std::move(row));
    }
    table.next_index();
  }
  return table;
}

Drawing draw(const std::vector<SectionVRun>& runs, const std::vector<Panel>& panels, double end) {
  std::string script =
      gnuplot_style(300 * panels.size()) + fmt::format("set xlabel 'time, s'\nset xrange [0:{:.4g}]\n", end);
  FigureTable table = table_of_runs(runs, panels);
  script += table.block();
  script += fmt::format("set multiplot layout {},1\n", panels.size());
  // Told apart by weight and dash: the weakest disturbance effect is the boldest line.
  constexpr std::array<std::string_view, 3> kStyles{
      "lw 1 dt 1 lc rgb '#888888'", "lw 1.8 dt 2 lc rgb '#444444'", "lw 2.2 dt 1 lc rgb '#000000'"};
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const Panel& panel = panels[p];
    script += fmt::format(
        "set ylabel '{}, {}'\nset yrange [{:.6g}:{:.6g}]\nplot {:.6g} with lines lw 4 lc rgb "
        "'#dddddd' title 'signal'",
        panel.quantity, panel.unit, panel.low, panel.high, panel.truth);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      script += fmt::format(", $runs index {} using 2:{} with lines {} title 'disturbance at {:.0f} rad/s'",
                            i, p + 3, kStyles[i % kStyles.size()], runs[i].disturbance_frequency);
    }
    script += '\n';
  }
  return {script + "unset multiplot\n", {std::move(table)}};
}

}  // namespace

std::vector<Figure> draw_kkl_figures(const certificates::Certificate& certificate) {
  const auto lambda = certificates::section_v_rates(kkl_observer_tables(certificate.design));
  if (!lambda) {
    return {};
  }
  const double ell = certificates::kkl_ell_in_use(certificate).nearest;
  std::vector<SectionVRun> kkl;
  std::vector<SectionVRun> adaptive;
  for (const double disturbance : kkl_observer::kSectionVDisturbances) {
    kkl.push_back(kkl_observer::run_kkl_section_v(*lambda, ell, disturbance));
    adaptive.push_back(kkl_observer::run_adaptive_section_v(disturbance));
  }
  const Panel amplitude{"amplitude", "signal units", 2.0, 1.0, 3.0, &EstimateSample::amplitude};
  const Panel frequency{"frequency", "rad/s", 3.0, 0.0, 5.0, &EstimateSample::frequency};
  Drawing estimates = draw(kkl, {amplitude, frequency}, 30.0);
  Drawing of_adaptive = draw(adaptive, {frequency}, 180.0);
  return {
      {"section-v.svg",
       "The simulations of the paper's section V (its Figures 1 to 6) with the ell in use: estimated "
       "amplitude and frequency over time (s) under a disturbance of amplitude 0.2 at 10, 100 and 1000 "
       "rad/s. Where a line is missing the observer has no estimate.",
       std::move(estimates.script), "Estimates in the simulations of section V", std::move(estimates.data)},
      {"section-v-adaptive.svg",
       "The adaptive observer on the same signals (the paper's Figures 7 to 9), with our own parameters: "
       "estimated frequency over time (s).",
       std::move(of_adaptive.script), "The adaptive observer on the same signals",
       std::move(of_adaptive.data)}};
}

}  // namespace veritrack::reports
