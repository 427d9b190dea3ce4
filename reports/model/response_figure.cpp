#include "reports/model/response_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "analysis/model/gain/linear_loop.hpp"
#include "analysis/rigor/rounding.hpp"
#include "reports/gnuplot.hpp"

namespace veritrack::reports {

namespace {

/// Rows enough for a line, and no more.
std::vector<std::size_t> places(std::size_t last) {
  constexpr std::size_t kMost = 400;
  const std::size_t step = std::max<std::size_t>(1, last / kMost);
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k <= last; k += step) {
    found.push_back(k);
  }
  return found;
}

/// To a little after the last sample that is 1 % off.
std::size_t shown_samples(const std::vector<double>& share) {
  constexpr double kNear = 0.01;
  std::size_t last = share.size() - 1;
  while (last > 8 && std::fabs(share[last] - 1.0) < kNear) {
    --last;
  }
  return std::min(share.size() - 1, last + last / 4 + 1);
}

}  // namespace

Figure response_figure(const model::GainProof& proof, const certificates::FrequencyUnits& units,
                       double sample_rate) {
  const rigor::NearestRounding nearest;
  constexpr int kFrequencies = 240;
  constexpr double kLowest = 1e-4;  // of half the sample rate
  const linear::LinearLoop loop = linear_loop(proof.gains->network());
  const std::vector<double> share = linear::followed_share(loop, proof.gains->samples());
  const bool in_seconds = units.has_hertz();
  const double unit = in_seconds ? 1e3 / sample_rate : 1.0;
  const std::string time = in_seconds ? "time after the step, ms" : "samples after the step";
  FigureTable step("step", {in_seconds ? "time after the step [ms]" : "time after the step [samples]",
                            "share of the step that the estimate has followed, not proved"});
  for (const std::size_t k : places(shown_samples(share))) {
    step.add({static_cast<double>(k) * unit, share[k]});
  }
  FigureTable noise("noise", {fmt::format("distance of the noise from the signal [{}]", units.drawn_unit()),
                              fmt::format("frequency error for noise of amplitude 1, not proved [{}]",
                                          units.drawn_unit())});
  bool passes_noise = false;  // none behind a clamp that always acts
  for (int i = 0; i <= kFrequencies; ++i) {
    const double omega = std::numbers::pi * std::pow(kLowest, 1.0 - static_cast<double>(i) / kFrequencies);
    const double gain = linear::noise_gain(loop, omega);
    passes_noise = passes_noise || gain > 0.0;
    noise.add({units.drawn(omega), units.drawn(gain)});
  }
  std::string script = gnuplot_style(560);
  script += step.block() + noise.block();
  script += fmt::format(
      "set lmargin 13\nset rmargin 3\nset format y '%.3g'\nset multiplot layout 2,1\n"
      "set offsets 0, 0, graph 0.1, 0\nset yrange [0:*]\nset xlabel '{}'\n"
      "set ylabel 'share followed' offset -1.5\n"
      "plot 1 with lines lw 1 dt 3 lc rgb '#888888' notitle, "
      "$step using 1:2 with lines lw 2 lc rgb '#000000' notitle\n"
      "set offsets 0, 0, 0, 0\nset logscale {}\nset autoscale\nset xlabel 'distance of the noise from the "
      "signal, {}'\n"
      "set ylabel 'error, {}' offset -1.5\n"
      "plot $noise using 1:2 with lines lw 2 lc rgb '#000000' notitle\nunset multiplot\n",
      time, passes_noise ? "xy" : "x", units.drawn_unit(), units.drawn_unit());
  return {
      "response.svg",
      fmt::format(
          "Computed from the linear loop, not proved. Above, the share of a step of the signal's frequency "
          "that the estimate has followed; below, the largest frequency error, {}, for noise of amplitude 1 "
          "at this distance from the signal's frequency, {}.",
          units.drawn_unit(), units.drawn_unit()),
      std::move(script),
      "Response to a step of the frequency, and to noise",
      {std::move(step), std::move(noise)}};
}

}  // namespace veritrack::reports
