#include "reports/quadrature/quadrature_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "certificates/quadrature/frequency_error_bounds.hpp"
#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "reports/line_styles.hpp"
#include "reports/quadrature/lock_figures.hpp"
#include "reports/quadrature/region_map.hpp"
#include "reports/simulated_run.hpp"

namespace veritrack::reports {

namespace {

using certificates::Certificate;
using theorems::TrajectoryRecord;

/// A horizontal line: its meaning, its value and how it looks.
struct Level {
  std::string title;
  double value = 0.0;
  const char* style = line::kCertified;
};

std::optional<double> long_run_bound(const Certificate& certificate) {
  if (!certificate.contraction || !certificate.contraction->starts.ultimate_frequency_error.applies()) {
    return std::nullopt;
  }
  const double bound = certificate.contraction->starts.ultimate_frequency_error.value.upper();
  return std::isfinite(bound) && bound > 0.0 ? std::optional(bound) : std::nullopt;
}

/// Bounds that far below the others are written in words: as lines they would take most of the axis.
constexpr double kWorthDrawing = 1e-3;

/// "Too small to draw: start error that (2.45) admits, printed: 2.24e-14." Takes them out of the levels.
std::string words_for_small(std::vector<Level>& levels, double largest) {
  for (const Level& level : levels) {
    largest = std::max(largest, level.value);
  }
  std::string words;
  for (const Level& level : levels) {
    if (level.value < kWorthDrawing * largest) {
      words += fmt::format("{} {}: ≈ {:.3g}", words.empty() ? " Too small to draw:" : ";", level.title,
                           level.value);
    }
  }
  std::erase_if(levels, [&](const Level& level) { return level.value < kWorthDrawing * largest; });
  return words.empty() ? words : words + ".";
}

/// Everything that the error is to be compared with, as far as it is a positive number.
std::vector<Level> error_levels(const Certificate& certificate) {
  std::vector<Level> levels;
  if (certificates::quadrature_tables(certificate.design).require.frequency_error_below) {
    levels.push_back(
        {"required",
         certificates::quadrature_tables(certificate.design).require.frequency_error_below->nearest,
         line::kRequired});
  }
  if (const auto bound = certificates::proved_frequency_bound(certificate)) {
    levels.push_back({"certified bound", bound->upper()});
  }
  if (const auto bound = long_run_bound(certificate)) {
    levels.push_back({"certified in the long run", *bound, line::kLongRun});
  }
  for (const theorems::Derivation& derivation : certificate.derivations) {
    for (const theorems::Quantity& quantity : derivation.quantities) {
      if (quantity.name == "lock_frequency_error" && quantity.applies()) {
        levels.push_back({"certified in lock", quantity.value.upper()});
      }
      const double bound = quantity.value.lower();
      if (quantity.name == "initial_error_bound" && std::isfinite(bound) && bound > 0.0) {
        levels.push_back(
            {fmt::format("start by (2.45), {}", derivation.id.substr(derivation.id.find('/') + 1)), bound,
             line::kPublished});
      }
    }
  }
  return levels;
}

/// The lines for the file of data.
FigureTable table_of_levels(const std::vector<Level>& levels) {
  FigureTable table("levels", {"line", "value [rad/sample]"});
  for (const Level& level : levels) {
    table.add({level.title, level.value});
  }
  return table;
}

Figure error_figure(const Certificate& certificate) {
  const double amplitude = certificates::quadrature_tables(certificate.design).assume.amplitude.nearest;
  std::string script = over_samples(420);
  FigureTable run = table_of_run(
      certificate,
      {"frequency error, simulated [rad/sample]", "whole error, simulated [relative and rad/sample]"},
      [amplitude](const TrajectoryRecord& record) {
        const auto positive = [](double value) { return value > 0.0 ? value : std::nan(""); };
        Eigen::Vector3d error = record.true_state - record.filtered_state;
        error.head<2>() /= amplitude;
        return std::array{positive(std::fabs(error[2])), positive(error.norm())};
      });
  script += run.block();
  script +=
      "set ylabel 'error'\n"
      "set logscale y\n"
      "unset mytics\n"
      "set format y '10^{%L}'\n"
      "set key maxcols 2\n";
  script += fmt::format(
      "plot $run using 1:3 with lines {} title 'whole error, simulated', "
      "'' using 1:2 with lines {} title 'frequency error, simulated'",
      line::kSignal, line::kSimulated);
  std::vector<Level> levels = error_levels(certificate);
  double largest = 0.0;
  for (const TrajectoryRecord& record : certificate.simulation.trajectory) {
    const double error = std::fabs(record.true_state[2] - record.filtered_state[2]);
    largest = std::isfinite(error) ? std::max(largest, error) : largest;
  }
  FigureTable table = table_of_levels(levels);
  const std::string small = words_for_small(levels, largest);
  for (const Level& level : levels) {
    script += fmt::format(", {:.9g} with lines {} title '{}'", level.value, level.style, level.title);
  }
  script += "\n";
  std::string caption =
      "Error of the tracker along the simulated run, logarithmic: the whole error |e(k|k)| (signal relative "
      "to its amplitude, and rad/sample) and the frequency error alone.";
  if (!levels.empty()) {
    caption +=
        " The black lines are bounds: of the frequency error, and of the start error that Theorem 2.9 admits "
        "by its condition (2.45).";
  }
  return {"error.svg",
          caption + small + stride_remark(certificate),
          std::move(script),
          "Error along the simulated run, with its bounds",
          {std::move(run), std::move(table)}};
}

FigureTable table_of_tube(const certificates::FrequencyErrorBounds& tube) {
  std::vector<std::string> columns{"sample", "certified bound of |frequency error| [rad/sample]"};
  for (std::size_t i = 0; i < tube.runs.size(); ++i) {
    columns.push_back(fmt::format("|frequency error|, simulated run {} [rad/sample]", i + 1));
  }
  FigureTable table("tube", std::move(columns));
  for (std::size_t k = 0; k < tube.bound.size(); ++k) {
    std::vector<FigureTable::Cell> row{static_cast<double>(k), tube.bound[k]};
    for (const std::vector<double>& run : tube.runs) {
      // Rounding that remains of a vanished error is not worth a decade of the picture.
      row.emplace_back(run[k] > 1e-3 * tube.bound.back() ? run[k] : std::nan(""));
    }
    table.add(std::move(row));
  }
  return table;
}

/// The runs in grey, thin, under the bound, black and broad.
Figure tube_figure(const Certificate& certificate, const certificates::FrequencyErrorBounds& tube) {
  std::string script = over_samples(380);
  FigureTable table = table_of_tube(tube);
  std::vector<Level> levels;
  script += table.block();
  script +=
      "set ylabel '|frequency error|, rad/sample'\n"
      "set logscale y\n"
      "unset mytics\n"
      "set format y '10^{%L}'\n"
      "set key maxcols 2\n"
      "plot ";
  for (std::size_t i = 0; i < tube.runs.size(); ++i) {
    script += fmt::format("$tube using 1:{} with lines {} notitle, ", i + 3, line::kSimulated);
  }
  script += fmt::format(
      "$tube using 1:2 with lines {} title 'certified, {}', "
      "keyentry with lines {} title 'simulated runs'",
      line::kCertified, tube.from_assumed_starts ? "assumed starts" : "the whole set", line::kSimulated);
  if (!tube.bound_of_assumed_starts.empty()) {
    levels.push_back({"certified, assumed starts", tube.bound_of_assumed_starts.front()});
    script += fmt::format(", {:.9g} with lines {} title 'certified, assumed starts'",
                          tube.bound_of_assumed_starts.front(), line::kAssumed);
  }
  if (const auto& required =
          certificates::quadrature_tables(certificate.design).require.frequency_error_below) {
    levels.push_back({"required", required->nearest});
    script += fmt::format(", {:.9g} with lines {} title 'required'", required->nearest, line::kRequired);
  }
  const auto long_run = long_run_bound(certificate);
  if (long_run) {
    levels.push_back({"certified, in the long run", *long_run});
    script +=
        fmt::format(", {:.9g} with lines {} title 'certified, in the long run'", *long_run, line::kLongRun);
  }
  script += "\n";
  return {
      "tube.svg",
      fmt::format(
          "Frequency error, rad/sample, logarithmic: the certified bound for every start {} and all assumed "
          "noise and slew (broad black){}, and simulated runs from the boundary of these starts (grey), "
          "without "
          "disturbances and with noise and slew that increase the errors. The runs prove nothing.",
          tube.from_assumed_starts ? "within the assumed errors" : "in the certified set",
          long_run ? ", the bound that it approaches in the long run (dash-dotted)" : ""),
      std::move(script),
      "Frequency error: certified bound and simulated runs",
      {std::move(table), table_of_levels(levels)}};
}

}  // namespace

std::vector<Figure> draw_quadrature_figures(const Certificate& certificate) {
  if (certificate.simulation.trajectory.empty()) {
    return {};
  }
  std::vector<Figure> figures = {frequency_figure(certificate), error_figure(certificate)};
  if (const auto tube = certificates::frequency_error_bounds(certificate)) {
    figures.push_back(tube_figure(certificate, *tube));
  }
  for (Figure& figure : draw_lock_figures(certificate)) {
    figures.push_back(std::move(figure));
  }
  const auto& followed_starts = certificates::quadrature_particulars(certificate).followed_starts;
  if (followed_starts && followed_starts->region.cells.size() > 1) {
    Figure map = draw_region_map(followed_starts->region, followed_starts->basin);
    map.file = "capture.svg";
    map.title = "The assumed starts that are captured";
    map.caption = "The assumed starts, followed under the assumed noise and slew. " + map.caption;
    figures.push_back(std::move(map));
  }
  return figures;
}

}  // namespace veritrack::reports
