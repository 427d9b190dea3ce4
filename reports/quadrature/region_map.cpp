#include "reports/quadrature/region_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "reports/gnuplot.hpp"
#include "reports/quadrature/region_values.hpp"

namespace veritrack::reports {

namespace {

using quadrature::BasinShares;
using quadrature::Region;
using quadrature::RegionCell;
using quadrature::SimulatedBasin;
using rigor::Verdict;

using Side = double MapRectangle::*;

/// Joins rectangles that agree in [kept_lower, kept_upper] and follow each other in the other direction.
void join_along(std::vector<MapRectangle>& rectangles, Side lower, Side upper, Side kept_lower,
                Side kept_upper) {
  const auto key = [&](const MapRectangle& r) {
    return std::array{r.*kept_lower, r.*kept_upper, r.*lower, r.*upper};
  };
  std::sort(rectangles.begin(), rectangles.end(),
            [&](const MapRectangle& a, const MapRectangle& b) { return key(a) < key(b); });
  std::vector<MapRectangle> result;
  for (const MapRectangle& next : rectangles) {
    const bool follows = !result.empty() && result.back().*kept_lower == next.*kept_lower &&
                         result.back().*kept_upper == next.*kept_upper && result.back().*upper == next.*lower;
    if (follows) {
      result.back().*upper = next.*upper;
    } else {
      result.push_back(next);
    }
  }
  rectangles = std::move(result);
}

template <typename Choice>
std::vector<MapRectangle> rectangles_of(const Region& region, Verdict verdict, const Choice& is_chosen) {
  std::vector<MapRectangle> rectangles;
  for (const RegionCell& cell : region.cells) {
    if (cell.verdict == verdict && is_chosen(cell)) {
      rectangles.push_back({cell.starts.frequency_error.lower(), cell.starts.frequency_error.upper(),
                            cell.starts.phase_error.lower(), cell.starts.phase_error.upper()});
    }
  }
  return joined(std::move(rectangles));
}

bool any(const RegionCell& /*cell*/) {
  return true;
}

/// Shades for starts that are captured, from the soonest to the latest.
constexpr std::array<std::string_view, 4> kShades{"#2c4a59", "#587f93", "#8aadbd", "#bcd5df"};

/// The latest sample of each shade: about equal steps from the soonest capture to the latest.
std::vector<int> capture_steps(const Region& region) {
  std::vector<int> samples;
  samples.reserve(region.cells.size());
  for (const RegionCell& cell : region.cells) {
    if (cell.verdict == Verdict::proved) {
      samples.push_back(cell.result.samples);
    }
  }
  if (samples.empty()) {
    return {0};
  }
  const auto [least, most] = std::minmax_element(samples.begin(), samples.end());
  const int shades = std::clamp(*most - *least + 1, 1, static_cast<int>(kShades.size()));
  std::vector<int> steps;
  steps.reserve(kShades.size());
  for (int i = 0; i < shades; ++i) {
    steps.push_back(shades == 1 ? *most : *least + ((*most - *least) * i) / (shades - 1));
  }
  return steps;
}

/// A gnuplot data block for `with boxxyerror`; NaN alone when there is nothing to draw.
std::string boxes(std::string_view name, const std::vector<MapRectangle>& rectangles) {
  std::string block = fmt::format("${} << END\n", name);
  for (const MapRectangle& r : rectangles) {
    block += fmt::format("{:.7g} {:.7g} {:.7g} {:.7g} {:.7g} {:.7g}\n",
                         0.5 * (r.frequency_lower + r.frequency_upper), 0.5 * (r.phase_lower + r.phase_upper),
                         r.frequency_lower, r.frequency_upper, r.phase_lower, r.phase_upper);
  }
  return block + (rectangles.empty() ? "NaN NaN NaN NaN NaN NaN\n" : "") + "END\n";
}

/// The lines between grid rectangles that lock and those that do not (or lie outside), as a data block.
std::string outline(const SimulatedBasin& basin) {
  const auto locks = [&](int i, int j) {
    return i >= 0 && j >= 0 && i < basin.phases && j < basin.frequencies && basin.locks_at(i, j);
  };
  const double phase_step = (basin.phase_error.upper() - basin.phase_error.lower()) / basin.phases;
  const double frequency_step =
      (basin.frequency_error.upper() - basin.frequency_error.lower()) / basin.frequencies;
  const auto point = [&](int i, int j) {
    return fmt::format("{:.6g} {:.6g}\n", basin.frequency_error.lower() + frequency_step * j,
                       basin.phase_error.lower() + phase_step * i);
  };
  std::string block = "$outline << END\n";
  // Runs of edges in one line are drawn as one.
  for (int i = 0; i <= basin.phases; ++i) {
    for (int j = 0; j < basin.frequencies; ++j) {
      const auto edge = [&](int k) { return k < basin.frequencies && locks(i - 1, k) != locks(i, k); };
      if (edge(j)) {
        block += point(i, j);
        while (edge(j)) {
          ++j;
        }
        block += point(i, j) + "\n";
      }
    }
  }
  for (int j = 0; j <= basin.frequencies; ++j) {
    for (int i = 0; i < basin.phases; ++i) {
      const auto edge = [&](int k) { return k < basin.phases && locks(k, j - 1) != locks(k, j); };
      if (edge(i)) {
        block += point(i, j);
        while (edge(i)) {
          ++i;
        }
        block += point(i, j) + "\n";
      }
    }
  }
  return block + "NaN NaN\nEND\n";
}

std::string caption(const Region& region, const SimulatedBasin& basin) {
  const BasinShares shares = shares_of_basin(region, basin);
  if (shares.points == 0) {
    return "Region of attraction over the start's frequency error (rad/sample) and phase error (rad). In "
           "simulation none of these starts locks.";
  }
  const std::string stopped =
      region.unfinished > 0
          ? fmt::format(" Stopped before the end: {} of the undecided cells were not looked at.",
                        region.unfinished)
          : "";
  return fmt::format(
      "Region of attraction over the start's frequency error (rad/sample) and phase error (rad): starts "
      "proved to be captured (blue, the darker the sooner), proved to lock at a wrong frequency (hatched) "
      "and undecided (light), "
      "with the outline of the basin found by simulating {} x {} starts. Proved: {} of the simulated basin; "
      "undecided: {}.{}",
      basin.frequencies, basin.phases, percent(shares.proved), percent(shares.undecided), stopped);
}

}  // namespace

std::vector<MapRectangle> joined(std::vector<MapRectangle> rectangles) {
  using R = MapRectangle;
  std::size_t before = 0;
  do {
    before = rectangles.size();
    join_along(rectangles, &R::frequency_lower, &R::frequency_upper, &R::phase_lower, &R::phase_upper);
    join_along(rectangles, &R::phase_lower, &R::phase_upper, &R::frequency_lower, &R::frequency_upper);
  } while (rectangles.size() < before);
  return rectangles;
}

std::string percent(double share) {
  if (share > 0.0 && share < 1.0) {
    return fmt::format("{:.1f} %", std::clamp(100.0 * share, 0.1, 99.9));
  }
  return share >= 1.0 ? "100 %" : "0 %";
}

Figure draw_region_map(const Region& region, const SimulatedBasin& basin) {
  std::string script = gnuplot_style(kRegionHeight) + kRegionPlace.margins() +
                       "set tics out\n"
                       "unset grid\n"
                       "set xlabel 'frequency error at the start, rad/sample'\n"
                       "set ylabel 'phase error at the start, rad'\n";
  script +=
      region.unfinished > 0
          ? fmt::format("set title 'stopped before the end: {} of the undecided cells were not looked at'\n",
                        region.unfinished)
          : "";
  script +=
      fmt::format("set xrange [{:.9g}:{:.9g}]\nset yrange [{:.9g}:{:.9g}]\n", basin.frequency_error.lower(),
                  basin.frequency_error.upper(), basin.phase_error.lower(), basin.phase_error.upper());
  const std::vector<int> steps = capture_steps(region);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    script +=
        boxes(fmt::format("proved{}", i), rectangles_of(region, Verdict::proved, [&](const RegionCell& cell) {
                return cell.result.samples <= steps[i] && (i == 0 || cell.result.samples > steps[i - 1]);
              }));
  }
  script += boxes("refuted", rectangles_of(region, Verdict::refuted, any));
  script += boxes("undecided", rectangles_of(region, Verdict::undecided, any));
  script += outline(basin);
  // Solid boxes carry a thin border of their own colour, or seams would show between them.
  const auto solid = [](std::string_view colour) {
    return fmt::format("boxxyerror fillcolor rgb '{0}' fs solid 1.0 border lc rgb '{0}' lw 0.5", colour);
  };
  constexpr std::string_view kHatched =
      "boxxyerror fillcolor rgb '#000000' fs transparent pattern 4 noborder";
  constexpr std::string_view kMiddle = "#d9cfbf";
  constexpr std::string_view kLight = "#eeeeee";
  for (std::size_t i = 0; i < steps.size(); ++i) {
    script += fmt::format("{}$proved{} using 1:2:3:4:5:6 with {} notitle", i == 0 ? "plot " : ", ", i,
                          solid(kShades.at(i)));
  }
  script += ", $refuted using 1:2:3:4:5:6 with " + solid(kMiddle) + " notitle";
  script += fmt::format(", '' using 1:2:3:4:5:6 with {} notitle", kHatched);
  script += ", $undecided using 1:2:3:4:5:6 with " + solid(kLight) + " notitle";
  script += ", $outline using 1:2 with lines lw 4 lc rgb '#ffffff' notitle";
  script += ", '' using 1:2 with lines lw 1.8 lc rgb '#000000' title 'basin in simulation'";
  const auto key = [&](std::string_view style, std::string_view title) {
    script += fmt::format(", keyentry with boxes {} title '{}'", style, title);
  };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    key(fmt::format("fillcolor rgb '{}' fs solid 1.0 noborder", kShades.at(i)),
        fmt::format("proved captured within {} samples", steps[i]));
  }
  key("fillcolor rgb '#000000' fs pattern 4 noborder", "proved to lock at a wrong frequency");
  key(fmt::format("fillcolor rgb '{}' fs solid 1.0 border lc rgb '#888888'", kLight), "undecided");
  script += '\n';
  return {"region.svg",
          caption(region, basin),
          std::move(script),
          "Region of attraction: starts that are captured",
          {table_of_region(region)},
          region_values(region, basin)};
}

}  // namespace veritrack::reports
