#include "reports/single_channel/single_channel_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/single_channel/frozen_observer.hpp"
#include "reports/gnuplot.hpp"
#include "reports/simulated_run.hpp"

namespace veritrack::reports {

namespace {

using certificates::Certificate;
using rigor::Interval;
using theorems::Derivation;

std::string preamble(std::size_t height, const char* x_label, const char* y_label) {
  return fmt::format("{}set xlabel '{}'\nset ylabel '{}'\n", gnuplot_style(height), x_label, y_label);
}

Interval value_of(const Derivation& derivation, const char* name) {
  return find_quantity(derivation, name).value;
}

/// The verified biases of the band, by frequency.
std::vector<Derivation> verified_biases(const Certificate& certificate) {
  std::vector<Derivation> found = certificates::derivations_of(certificate, "single-channel-bias");
  std::erase_if(found, [](const Derivation& one) { return one.verdict != rigor::Verdict::proved; });
  std::stable_sort(found.begin(), found.end(), [](const Derivation& a, const Derivation& b) {
    return value_of(a, "frequency").lower() < value_of(b, "frequency").lower();
  });
  return found;
}

Figure bias_figure(const std::vector<Derivation>& biases) {
  std::string script = preamble(360, "frequency of the signal, rad/sample", "frequency error, rad/sample");
  // A bias that is exactly zero has no scale.
  const bool is_zero = std::all_of(biases.begin(), biases.end(), [](const Derivation& bias) {
    return value_of(bias, "min_error").lower() == 0.0 && value_of(bias, "max_error").upper() == 0.0;
  });
  FigureTable table(
      "bias", {"frequency of the tone [rad/sample]", "mean bias [rad/sample]", "least error [rad/sample]",
               "largest error [rad/sample]", "bias of the quadrature tracker [rad/sample]"});
  for (const Derivation& bias : biases) {
    const theorems::Quantity& quadrature = find_quantity(bias, "quadrature_bias");
    table.add({midpoint(value_of(bias, "frequency")), midpoint(value_of(bias, "mean_bias")),
               value_of(bias, "min_error").lower(), value_of(bias, "max_error").upper(),
               quadrature.not_applicable ? std::nan("") : midpoint(quadrature.value)});
  }
  script += table.block();
  script += "set offsets graph 0.05, graph 0.05, graph 0.08, graph 0.08\n";
  script += is_zero ? "set yrange [-1:1]\nunset ytics\nset ytics ('0' 0)\n" : "";
  script +=
      "plot 0 with lines lw 0.8 lc rgb '#888888' notitle, "
      "$bias using 1:2:3:4 with yerrorbars lw 1.6 pt 0 lc rgb '#888888' title 'ripple', "
      "'' using 1:2 with linespoints lw 1.4 pt 7 ps 0.6 lc rgb '#000000' title 'mean bias', "
      "'' using 1:5 with linespoints lw 1.4 dt 2 pt 6 ps 0.7 lc rgb '#000000' title 'quadrature "
      "tracker'\n";
  return {
      "bias.svg",
      "Steady-state error of the frequency estimate on a noise-free tone, rad/sample, against the frequency "
      "of the tone: mean over the phase (black) and the range of the ripple (grey bars). The enclosures of "
      "all of them are narrower than the lines.",
      std::move(script),
      "Bias and ripple over the frequency of the tone",
      {std::move(table)}};
}

/// |G| of the frozen filter over cells of the frequency axis: each cell drawn from its lower to its upper
/// bound.
Figure response_figure(const Derivation& filter) {
  const rigor::UpwardRounding upward;
  constexpr int kCells = 400;
  const single_channel::FrozenGain<Interval> gain{value_of(filter, "gain_1"), value_of(filter, "gain_2"),
                                                  value_of(filter, "zero_angle")};
  std::string script = preamble(360, "frequency, rad/sample", "|G|");
  FigureTable table("response", {"frequency [rad/sample]", "|G| from below [1]", "|G| from above [1]"});
  constexpr double kFloor = 1e-3;  // of the drawing; |G| has zeros
  for (int i = 0; i < kCells; ++i) {
    const double left = rigor::pi().upper() * i / kCells;
    const double right = rigor::pi().upper() * (i + 1) / kCells;
    const Interval magnitude = single_channel::response_magnitude(gain, Interval::from_bounds(left, right));
    if (rigor::is_finite(magnitude)) {
      table.add(
          {0.5 * (left + right), std::max(magnitude.lower(), kFloor), std::max(magnitude.upper(), kFloor)});
    }
  }
  script += table.block();
  script += fmt::format(
      "set logscale y\n"
      "set yrange [{}:*]\n"
      "set xrange [0:3.15]\n"
      "plot $response using 1:2:3 with filledcurves fc rgb '#000000' title 'enclosure of |G|', "
      "'' using 1:3 with lines lw 1.2 lc rgb '#000000' notitle\n",
      kFloor);
  return {
      "response.svg",
      "Response of the filter with frozen frequency and gain, from the measurement to the innovation, "
      "logarithmic, as an enclosure over 400 cells. Its zero is at the frozen frequency. It is cut off at "
      "0.001.",
      std::move(script),
      "Response of the filter with frozen frequency",
      {std::move(table)}};
}

}  // namespace

std::vector<Figure> draw_single_channel_figures(const Certificate& certificate) {
  if (certificate.simulation.trajectory.empty()) {
    return {};
  }
  std::vector<Figure> figures{frequency_figure(certificate)};
  const std::vector<Derivation> biases = verified_biases(certificate);
  if (biases.size() > 1) {
    figures.push_back(bias_figure(biases));
  }
  const std::vector<Derivation> filter =
      certificates::derivations_of(certificate, "single-channel/transfer-function");
  if (!filter.empty() && filter.front().verdict == rigor::Verdict::proved) {
    figures.push_back(response_figure(filter.front()));
  }
  return figures;
}

}  // namespace veritrack::reports
