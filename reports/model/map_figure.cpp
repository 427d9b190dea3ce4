#include "reports/model/map_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "certificates/document/markdown_text.hpp"
#include "reports/gnuplot.hpp"
#include "reports/page/map_values.hpp"

namespace veritrack::reports {

namespace {

using certificates::MappedState;
using certificates::ModelMap;

constexpr std::array<std::string_view, 5> kShades{"#3a3a3a", "#666666", "#8e8e8e", "#b2b2b2", "#d2d2d2"};

/// "x y left right below above" for each cell that is chosen; NaN alone when there is none.
template <typename Choice>
std::string map_cells(std::string_view name, const ModelMap& map, const Choice& is_chosen) {
  std::string block = fmt::format("${} << END\n", name);
  bool is_any = false;
  for (std::size_t row = 0; row < map.grid.rows(); ++row) {
    for (std::size_t column = 0; column < map.grid.columns(); ++column) {
      if (is_chosen(map.grid.cell(column, row))) {
        const double left = map.grid.x[column];
        const double right = map.grid.x[column + 1];
        const double below = map.grid.y[row];
        const double above = map.grid.y[row + 1];
        block += fmt::format("{:.7g} {:.7g} {:.7g} {:.7g} {:.7g} {:.7g}\n", 0.5 * (left + right),
                             0.5 * (below + above), left, right, below, above);
        is_any = true;
      }
    }
  }
  return block + (is_any ? "" : "NaN NaN NaN NaN NaN NaN\n") + "END\n";
}

/// Where the axes are in the picture, of this size.
constexpr page::PlotPlace kPlace{0.11, 0.97, 0.24, 0.97};
constexpr std::size_t kWidth = 820;
constexpr std::size_t kHeight = 600;

/// "rad" with a space before it; nothing when the state has no unit.
std::string unit_of(const MappedState& state) {
  return state.unit.empty() ? "" : " " + state.unit;
}

/// The values of each cell, for a page.
std::string values_of(const ModelMap& map) {
  enum Kind : std::size_t { proved, simulated_only, lost };
  page::MapValues values;
  values.x = {map.grid.x.front(), map.grid.x.back()};
  values.y = {map.grid.y.front(), map.grid.y.back()};
  values.sentence = fmt::format(
      "Starts that deviate by {{x0}} to {{x1}}{} in {} and by {{y0}} to {{y1}}{} in {}: {{kind}}.",
      unit_of(map.x), map.x.name, unit_of(map.y), map.y.name);
  values.kinds = {"proved to be in the certified set after at most {samples} samples, at every phase",
                  "not proved; in simulation the one in the middle locks at each phase",
                  "not proved; in simulation the one in the middle does not lock, at some phase"};
  for (std::size_t row = 0; row < map.grid.rows(); ++row) {
    for (std::size_t column = 0; column < map.grid.columns(); ++column) {
      const std::size_t cell = map.grid.cell(column, row);
      const Kind kind = map.cells[cell].is_proved   ? proved
                        : map.simulated.locks(cell) ? simulated_only
                                                    : lost;
      values.cells.push_back({map.grid.x[column], map.grid.x[column + 1], map.grid.y[row],
                              map.grid.y[row + 1], 0.0, 0.0, kind, map.cells[cell].samples});
    }
  }
  return map_values_json(values, kPlace, kWidth, kHeight);
}

/// "deviation of theta at the start, rad".
std::string axis_of(const MappedState& state) {
  return fmt::format("deviation of {} at the start{}{}", state.name, state.unit.empty() ? "" : ", ",
                     state.unit);
}

std::string caption_of(const ModelMap& map) {
  return fmt::format(
      "Which starts lock, over their deviation from the steady state in {} and in {}, at every phase of the "
      "signal. Grey: proved, the darker the sooner; hatched: in simulation only; dotted: not in simulation, "
      "at "
      "some phase. The line is the edge of the certified set. Proved: {} of {} cells.",
      certificates::markdown::escaped(labelled(map.x)), certificates::markdown::escaped(labelled(map.y)),
      map.proved(), map.cells.size());
}

}  // namespace

std::string labelled(const MappedState& state) {
  return state.unit.empty() ? state.name : fmt::format("{}, {}", state.name, state.unit);
}

std::vector<std::size_t> capture_steps(const ModelMap& map) {
  const std::size_t most = map.longest();
  if (most == 0) {
    return {0};
  }
  // A round number of samples to a shade.
  const double exact = static_cast<double>(most) / static_cast<double>(kShades.size());
  const double unit = std::pow(10.0, std::floor(std::log10(exact)));
  double width = 10.0 * unit;
  for (const double factor : {8.0, 6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.2, 1.0}) {
    width = factor * unit >= exact ? factor * unit : width;
  }
  const auto step = static_cast<std::size_t>(std::ceil(std::max(width, 1.0)));
  std::vector<std::size_t> steps;
  for (std::size_t i = 1; i <= kShades.size() && (steps.empty() || steps.back() < most); ++i) {
    steps.push_back(i * step);
  }
  return steps;
}

Figure draw_model_map(const ModelMap& map) {
  std::string script = gnuplot_style(kHeight) + kPlace.margins() +
                       fmt::format(
                           "set tics out\nunset grid\n"
                           "set xlabel {}\nset ylabel {}\n"
                           "set xrange [{:.9g}:{:.9g}]\nset yrange [{:.9g}:{:.9g}]\n",
                           gnuplot_text(axis_of(map.x)), gnuplot_text(axis_of(map.y)), map.grid.x.front(),
                           map.grid.x.back(), map.grid.y.front(), map.grid.y.back());
  const std::vector<std::size_t> steps = capture_steps(map);
  std::string plot = "plot ";
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::string name = fmt::format("proved{}", i);
    script += map_cells(name, map, [&](std::size_t cell) {
      const std::size_t samples = map.cells[cell].samples;
      return map.cells[cell].is_proved && samples <= steps[i] && (i == 0 || samples > steps[i - 1]);
    });
    // The thin border of the same colour hides seams.
    plot += fmt::format(
        "${0} using 1:2:3:4:5:6 with boxxyerror fillcolor rgb '{1}' fs solid 1.0 border lc rgb '{1}' lw 0.5 "
        "title 'proved, within {2} samples', ",
        name, kShades.at(i), steps[i]);
  }
  script += map_cells("simulated", map, [&](std::size_t cell) {
    return !map.cells[cell].is_proved && map.simulated.locks(cell);
  });
  script += map_cells("lost", map, [&](std::size_t cell) { return !map.simulated.locks(cell); });
  plot +=
      "$simulated using 1:2:3:4:5:6 with boxxyerror fillcolor rgb '#777777' fs pattern 4 noborder title "
      "'locks in simulation only', "
      "$lost using 1:2 with points pt 7 ps 0.25 lc rgb '#000000' title 'does not lock in simulation', ";
  script += "$edge << END\n";
  for (const std::array<double, 2>& point : map.edge) {
    script += fmt::format("{:.7g} {:.7g}\n", point[0], point[1]);
  }
  script += "END\n";
  plot +=
      "$edge using 1:2 with lines lw 4 lc rgb '#ffffff' notitle, '' using 1:2 with lines lw 1.6 lc rgb "
      "'#000000' title 'edge of the certified set'\n";
  return {"region.svg", caption_of(map), script + plot, "Map of the starts that lock", {}, values_of(map)};
}

}  // namespace veritrack::reports
