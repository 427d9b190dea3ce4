#include "papers/reproductions/vibration_figures.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "papers/experiments/vibration_runs.hpp"
#include "papers/reproductions/line_panels.hpp"
#include "papers/reproductions/vibration_controllers.hpp"

namespace veritrack::reports::vibration {

namespace {

using experiments::Estimator;
using experiments::VibrationOrder;
using experiments::VibrationStart;

/// The start of the figures: nothing known.
VibrationStart start_drawn(VibrationOrder order) {
  VibrationStart start{1.0, 0.5, 10.0, experiments::ideal_parameters(order)};
  start.parameters.setZero();
  start.parameters(start.parameters.size() / 2) = 2.0;
  return start;
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

}  // namespace

Figure draw_example_1(double limit) {
  constexpr int kShown = 300;
  const auto efra = experiments::vibration_run(VibrationOrder::three, Estimator::efra,
                                               start_drawn(VibrationOrder::three), kShown);
  const auto monitored = experiments::vibration_run(VibrationOrder::three, Estimator::monitored,
                                                    start_drawn(VibrationOrder::three), kShown, limit);
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
        const std::complex<double> value = response(both.at(i).second, frequency);
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

}  // namespace veritrack::reports::vibration
