#include "reports/figures.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <variant>

#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/tube.hpp"
#include "reports/gnuplot.hpp"
#include "reports/kkl_observer/kkl_figures.hpp"
#include "reports/quadrature/region_map.hpp"
#include "reports/single_channel/single_channel_figures.hpp"

namespace veritrack::reports {

namespace {

using certificates::Certificate;
using theorems::TrajectoryRecord;

constexpr std::size_t kLargestNumberOfPoints = 2000;

/// Every how many samples a point is drawn.
std::size_t stride(const Certificate& certificate) {
  return (certificate.simulation.trajectory.size() + kLargestNumberOfPoints - 1) / kLargestNumberOfPoints;
}

std::string stride_remark(const Certificate& certificate) {
  const std::size_t every = stride(certificate);
  return every == 1 ? "" : fmt::format(" One sample in {} is drawn.", every);
}

/// A gnuplot data block: step, then the columns that `values` gives.
template <typename Values>
std::string data_block(const Certificate& certificate, Values values) {
  std::string block = "$run << END\n";
  const theorems::Trajectory& trajectory = certificate.simulation.trajectory;
  for (std::size_t k = 0; k < trajectory.size(); k += stride(certificate)) {
    block += std::to_string(k);
    for (const double value : values(trajectory[k])) {
      block += std::isfinite(value) ? fmt::format(" {:.9g}", value) : " NaN";
    }
    block += '\n';
  }
  return block + "END\n";
}

/// The style of a figure over the samples.
std::string over_samples(std::size_t height) {
  return gnuplot_style(height) + "set xlabel 'sample k'\n";
}

Figure frequency_figure(const Certificate& certificate) {
  std::string script = over_samples(340);
  script += data_block(certificate, [](const TrajectoryRecord& record) {
    return std::array{record.true_state[2], record.filtered_state[2]};
  });
  script +=
      "set ylabel 'frequency, rad/sample'\n"
      "set offsets 0, 0, graph 0.08, graph 0.08\n"
      "plot $run using 1:2 with lines lw 3 lc rgb '#aaaaaa' title 'signal', "
      "'' using 1:3 with lines lw 1.4 dt 1 lc rgb '#000000' title 'tracker'\n";
  return {"frequency.svg",
          "Frequency of the signal (broad grey) and of the tracker (thin black), rad/sample, along the "
          "simulated run." +
              stride_remark(certificate),
          run_gnuplot(script)};
}

/// Dash patterns that can be told apart in grey.
constexpr std::array kDashes{"'-'", "'_'", "'.'", "'-.'", "'-..'"};

/// A horizontal line: what it stands for, and where.
struct Level {
  std::string title;
  double value = 0.0;
};

/// Everything that the error is to be compared with, as far as it is a positive number.
std::vector<Level> error_levels(const Certificate& certificate) {
  std::vector<Level> levels;
  if (certificate.design.quadrature_ekf().require.frequency_error_below) {
    levels.push_back({"required of the frequency error",
                      certificate.design.quadrature_ekf().require.frequency_error_below->nearest});
  }
  if (const auto bound = certificates::proved_frequency_bound(certificate)) {
    levels.push_back({"certified bound of the frequency error", bound->upper()});
  }
  for (const theorems::Derivation& derivation : certificate.derivations) {
    for (const theorems::Quantity& quantity : derivation.quantities) {
      const double bound = quantity.value.lower();
      if (quantity.name == "initial_error_bound" && std::isfinite(bound) && bound > 0.0) {
        levels.push_back({fmt::format("start error that (2.45) admits, {}",
                                      derivation.id.substr(derivation.id.find('/') + 1)),
                          bound});
      }
    }
  }
  return levels;
}

Figure error_figure(const Certificate& certificate) {
  const double amplitude = certificate.design.quadrature_ekf().assume.amplitude.nearest;
  std::string script = over_samples(420);
  script += data_block(certificate, [amplitude](const TrajectoryRecord& record) {
    const auto positive = [](double value) { return value > 0.0 ? value : std::nan(""); };
    Eigen::Vector3d error = record.true_state - record.filtered_state;
    error.head<2>() /= amplitude;
    return std::array{positive(std::fabs(error[2])), positive(error.norm())};
  });
  script +=
      "set ylabel 'error'\n"
      "set logscale y\n"
      "unset mytics\n"
      "set format y '10^{%L}'\n"
      "set key maxcols 2\n"
      "plot $run using 1:3 with lines lw 3 lc rgb '#aaaaaa' title 'whole error |e(k|k)|', "
      "'' using 1:2 with lines lw 1.4 lc rgb '#000000' title 'frequency error, rad/sample'";
  const std::vector<Level> levels = error_levels(certificate);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    script += fmt::format(", {:.9g} with lines lw 1.8 dt {} lc rgb '#000000' title '{}'", levels[i].value,
                          kDashes.at(i % kDashes.size()), levels[i].title);
  }
  script += "\n";
  std::string caption =
      "Error of the tracker along the simulated run, logarithmic: the whole error |e(k|k)| (signal relative "
      "to its amplitude, and rad/sample) and the frequency error alone.";
  if (!levels.empty()) {
    caption += " The dashed lines are what it is to be compared with.";
  }
  return {"error.svg", caption + stride_remark(certificate), run_gnuplot(script)};
}

/// The runs in grey, thin, under the bound, black and broad.
Figure tube_figure(const Certificate& certificate, const certificates::Tube& tube) {
  std::string script = over_samples(380);
  script += "$tube << END\n";
  for (std::size_t k = 0; k < tube.bound.size(); ++k) {
    script += fmt::format("{} {:.9g}", k, tube.bound[k]);
    for (const std::vector<double>& run : tube.runs) {
      // What rounding leaves of an error that is gone is not worth a decade of the picture.
      script += run[k] > 1e-3 * tube.bound.back() ? fmt::format(" {:.9g}", run[k]) : " NaN";
    }
    script += '\n';
  }
  script +=
      "END\n"
      "set ylabel '|frequency error|, rad/sample'\n"
      "set logscale y\n"
      "unset mytics\n"
      "set format y '10^{%L}'\n"
      "set key maxcols 2\n"
      "plot ";
  for (std::size_t i = 0; i < tube.runs.size(); ++i) {
    script += fmt::format("$tube using 1:{} with lines lw 1 lc rgb '#888888' notitle, ", i + 3);
  }
  script += fmt::format(
      "$tube using 1:2 with lines lw 3 lc rgb '#000000' title 'certified, {}', "
      "keyentry with lines lw 1 lc rgb '#888888' title 'simulated runs'",
      tube.from_assumed_starts ? "assumed starts" : "all of the set");
  if (!tube.bound_of_assumed_starts.empty()) {
    script +=
        fmt::format(", {:.9g} with lines lw 1.8 dt 4 lc rgb '#000000' title 'certified, assumed starts'",
                    tube.bound_of_assumed_starts.front());
  }
  if (const auto& required = certificate.design.quadrature_ekf().require.frequency_error_below) {
    script +=
        fmt::format(", {:.9g} with lines lw 1.8 dt 2 lc rgb '#000000' title 'required'", required->nearest);
  }
  script += "\n";
  return {"tube.svg",
          fmt::format("Frequency error, rad/sample, logarithmic: the bound that is certified for every start "
                      "{} and all noise and slew assumed (black), and simulated runs from the rim of these "
                      "starts (grey), without disturbances and with noise and slew that push the errors out. "
                      "The runs prove nothing.",
                      tube.from_assumed_starts ? "within the assumed errors" : "in the certified set"),
          run_gnuplot(script)};
}

}  // namespace

std::vector<Figure> draw_figures(const Certificate& certificate) {
  if (std::holds_alternative<certificates::KklObserverTables>(certificate.design.tables)) {
    return draw_kkl_figures(certificate);
  }
  if (certificate.simulation.trajectory.empty()) {
    return {};
  }
  if (std::holds_alternative<certificates::SingleChannelEkfTables>(certificate.design.tables)) {
    std::vector<Figure> figures = draw_single_channel_figures(certificate);
    figures.insert(figures.begin(), frequency_figure(certificate));
    return figures;
  }
  std::vector<Figure> figures = {frequency_figure(certificate), error_figure(certificate)};
  if (const auto tube = certificates::certified_tube(certificate)) {
    figures.push_back(tube_figure(certificate, *tube));
  }
  if (certificate.followed_starts && certificate.followed_starts->region.cells.size() > 1) {
    Figure map = draw_region_map(certificate.followed_starts->region, certificate.followed_starts->basin);
    map.file = "capture.svg";
    map.caption = "The assumed starts, followed under the assumed noise and slew. " + map.caption;
    figures.push_back(std::move(map));
  }
  return figures;
}

}  // namespace veritrack::reports
