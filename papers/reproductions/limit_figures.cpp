#include "papers/reproductions/limit_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "papers/limits/posterior_bound.hpp"
#include "papers/limits/tone_bounds.hpp"

namespace veritrack::reports {

namespace {

using limits::Channels;

/// Two panels one above the other with logarithmic error axes.
std::string preamble(const char* x_label) {
  return fmt::format(
      "set terminal svg size 820,900 font 'sans-serif,13' background '#ffffff' rounded\n"
      "set border 3 lw 1 lc rgb '#444444'\nset tics nomirror\nset grid ytics lw 0.5 lc rgb '#cccccc'\n"
      "set logscale y\nset format y '10^{{%L}}'\nset ylabel '(rad/sample)^2'\nset xlabel '{}'\n"
      "set key outside right top vertical samplen 3\n",
      x_label);
}

const char* panel_title(Channels channels) {
  return channels == Channels::quadrature ? "both channels measured (quadrature tracker)"
                                          : "one channel measured (single-channel tracker)";
}

std::string random_walk_panel(const std::vector<limits::RandomWalkSeries>& study, Channels channels) {
  constexpr std::array<int, limits::kWalkVariances.size()> kOpenPoints{6, 4, 8};  // circle, square, triangle
  std::string blocks;
  std::string plots;
  for (const limits::RandomWalkSeries& series : study) {
    if (series.channels != channels) {
      continue;
    }
    const auto variances = limits::kWalkVariances.begin();
    const auto index = static_cast<std::size_t>(
        std::find(variances, limits::kWalkVariances.end(), series.walk_variance) - variances);
    const bool matched = series.q1_share == 0.0;
    const std::string name = fmt::format("$walk{}_{}_{}", channels == Channels::single ? 1 : 2, index,
                                         matched ? "matched" : "looser");
    blocks += name + " << END\n";
    for (const limits::LimitPoint& point : series.points) {
      blocks += fmt::format("{} {:.6g} {:.6g}\n", point.decibels, point.bound, point.error);
    }
    blocks += "END\n";
    plots += plots.empty() ? "" : ", ";
    if (matched) {
      plots += fmt::format(
          "{0} using 1:2 with lines lw 1.4 dt {1} lc rgb '#777777' title 'bound, walk {2:.1g}', {0} using "
          "1:3 with points pt {3} ps 0.8 lw 1.4 lc rgb '#000000' title 'tracker, walk {2:.1g}'",
          name, index + 1, series.walk_variance, kOpenPoints.at(index));
    } else {
      plots +=
          fmt::format("{} using 1:3 with points pt 2 ps 0.5 lw 1.2 lc rgb '#000000' title 'with q1 = {} q2'",
                      name, series.q1_share);
    }
  }
  return blocks + fmt::format("set title '{}'\nplot {}\n", panel_title(channels), plots);
}

/// The bounds after so many samples of a constant frequency.
struct BoundsAt {
  int samples;
  double bound, start_unknown;
};

std::vector<BoundsAt> bounds_over_time(Channels channels) {
  const limits::TrackingModel model = limits::constant_frequency_model(channels, limits::kOverTimeDecibels);
  const std::vector<double> bounds = limits::posterior_frequency_bounds(model, limits::kLateSample);
  std::vector<BoundsAt> all;
  all.reserve(bounds.size());
  for (int n = 4; n <= limits::kLateSample; ++n) {
    const double tone =
        channels == Channels::quadrature
            ? limits::complex_tone_bound(model.noise_variance, n)
            : limits::real_tone_bound(model.noise_variance, limits::kMeanFrequency, limits::kMeanPhase, n);
    all.push_back({n, bounds[static_cast<std::size_t>(n - 1)], tone});
  }
  return all;
}

std::string over_time_panel(const std::vector<limits::ErrorOverTime>& study, Channels channels) {
  const std::string suffix = channels == Channels::single ? "1" : "2";
  std::string blocks = "$bound" + suffix + " << END\n";
  for (const BoundsAt& at : bounds_over_time(channels)) {
    blocks += fmt::format("{} {:.6g} {:.6g}\n", at.samples, at.bound, at.start_unknown);
  }
  blocks += "END\n";
  std::string plots = fmt::format(
      "$bound{0} using 1:2 with lines lw 4 lc rgb '#bbbbbb' title 'bound', $bound{0} using 1:3 with lines lw "
      "1.2 dt 3 lc rgb '#777777' title 'bound, start unknown'",
      suffix);
  int index = 0;
  for (const limits::ErrorOverTime& series : study) {
    if (series.channels != channels) {
      continue;
    }
    const std::string name = fmt::format("$time{}_{}", suffix, index);
    blocks += name + " << END\n";
    for (std::size_t k = 3; k < series.mean_square.size(); ++k) {
      blocks += fmt::format("{} {:.6g}\n", k + 1, series.mean_square[k]);
    }
    blocks += "END\n";
    plots += fmt::format(", {} using 1:2 with lines lw 1.2 dt {} lc rgb '#000000' title 'q2 = {:.1g}'", name,
                         index + 1, series.tracker_q2);
    ++index;
  }
  return blocks + fmt::format("set title '{}'\nplot {}\n", panel_title(channels), plots);
}

std::string name_of(Channels channels) {
  return channels == Channels::quadrature ? "quadrature" : "single channel";
}

FigureTable table_of_walks(const std::vector<limits::RandomWalkSeries>& study) {
  FigureTable table("walks",
                    {"tracker", "walk variance [(rad/sample)^2]", "q1/q2 [1]", "signal-to-noise ratio [dB]",
                     "bound [(rad/sample)^2]", "mean square error, simulated [(rad/sample)^2]"});
  for (const limits::RandomWalkSeries& series : study) {
    for (const limits::LimitPoint& point : series.points) {
      table.add({name_of(series.channels), series.walk_variance, series.q1_share, point.decibels, point.bound,
                 point.error});
    }
  }
  return table;
}

FigureTable table_of_errors(const std::vector<limits::ErrorOverTime>& study) {
  FigureTable table("errors", {"tracker", "q2 [(rad/sample)^2]", "samples",
                               "mean square error, simulated [(rad/sample)^2]"});
  for (const limits::ErrorOverTime& series : study) {
    for (std::size_t k = 3; k < series.mean_square.size(); ++k) {
      table.add(
          {name_of(series.channels), series.tracker_q2, static_cast<double>(k + 1), series.mean_square[k]});
    }
  }
  return table;
}

FigureTable table_of_bounds() {
  FigureTable table(
      "bounds", {"tracker", "samples", "bound [(rad/sample)^2]", "bound, start unknown [(rad/sample)^2]"});
  for (const Channels channels : {Channels::quadrature, Channels::single}) {
    for (const BoundsAt& at : bounds_over_time(channels)) {
      table.add({name_of(channels), static_cast<double>(at.samples), at.bound, at.start_unknown});
    }
  }
  return table;
}

template <typename Panel>
std::string draw_panels(const std::string& script, const Panel& panel) {
  const std::string above = panel(Channels::quadrature);
  const std::string below = panel(Channels::single);
  return script + "set multiplot layout 2,1\n" + above + below + "unset multiplot\n";
}

}  // namespace

Figure draw_random_walks(const std::vector<limits::RandomWalkSeries>& study) {
  return {"random-walk.svg",
          {},
          draw_panels(preamble("signal-to-noise ratio, dB") + "set xrange [-0.5:30.5]\nset xtics 3\n",
                      [&](Channels channels) { return random_walk_panel(study, channels); }),
          "Error of the two trackers and the bound over the signal-to-noise ratio",
          {table_of_walks(study)}};
}

Figure draw_errors_over_time(const std::vector<limits::ErrorOverTime>& study) {
  return {"constant.svg",
          {},
          draw_panels(preamble("samples since the start") +
                          "set logscale x\nset xrange [4:1000]\nset yrange [1e-11:1e-2]\n",
                      [&](Channels channels) { return over_time_panel(study, channels); }),
          "Error of the two trackers and the bound over the number of samples",
          {table_of_errors(study), table_of_bounds()}};
}

}  // namespace veritrack::reports
