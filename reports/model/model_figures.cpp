#include "reports/model/model_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "analysis/model/step/point_tube.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "reports/gnuplot.hpp"
#include "reports/model/least_of_parts.hpp"
#include "reports/model/response_figure.hpp"
#include "reports/model/tube_figure.hpp"

namespace veritrack::reports {

namespace {

using certificates::FrequencyUnits;
using model::FrequencySlice;
using model::ProvedSet;
using model::ProvedTube;

/// "frequency of the signal [Hz]", and the like.
std::string in_unit(const char* quantity, const FrequencyUnits& units) {
  return fmt::format("{} [{}]", quantity, units.drawn_unit());
}

/// The proved bias and ripple over each cell of frequencies: a row for each of its ends.
FigureTable table_of_cells(const std::vector<FrequencySlice>& cells, const FrequencyUnits& units) {
  FigureTable table("cells", {in_unit("frequency of the signal", units), in_unit("bias, at least", units),
                              in_unit("bias, at most", units), in_unit("ripple, at most", units)});
  for (const FrequencySlice& cell : cells) {
    for (const double place : {cell.low, cell.high}) {
      table.add({units.drawn(place), units.drawn(cell.bias.lower()), units.drawn(cell.bias.upper()),
                 units.drawn(cell.ripple)});
    }
  }
  return table;
}

/// Lines are not drawn from the tubes of a part of the amplitudes to those of the next one, which begin at
/// low frequencies again.
class LinesOfParts {
 public:
  explicit LinesOfParts(FigureTable& table) : table_(&table) {}
  void begin(const ProvedTube& proved) {
    if (proved.tube.frequency < last_) {
      table_->gap();
    }
    last_ = proved.tube.frequency;
  }

 private:
  FigureTable* table_;
  double last_ = 0.0;
};

/// The mean and the range of the frequency error on the curve of a tube, in floating point, over its
/// frequencies.
FigureTable table_on_curve(const model::TrackerModel& tracker, const std::vector<ProvedTube>& tubes,
                           const FrequencyUnits& units) {
  constexpr int kPhases = 256;
  constexpr std::size_t kPlaces = 60;
  const std::size_t each = std::max<std::size_t>(2, kPlaces / tubes.size());
  model::PointTracker points(tracker);
  model::PointFrame frame;
  FigureTable table("curve", {in_unit("frequency of the signal", units), in_unit("bias, not proved", units),
                              in_unit("ripple, not proved", units)});
  LinesOfParts lines(table);
  for (const ProvedTube& proved : tubes) {
    lines.begin(proved);
    for (std::size_t i = 0; i <= each; ++i) {
      const double z = 2.0 * static_cast<double>(i) / static_cast<double>(each) - 1.0;
      const double frequency = proved.tube.frequency + z * proved.tube.half_width;
      const model::PointTube tube(proved.tube, frequency);
      double sum = 0.0;
      double least = INFINITY;
      double most = -least;
      for (int j = 0; j < kPhases; ++j) {
        tube.at(2.0 * std::numbers::pi * j / kPhases, frame);
        const double error = points.frequency(frame.curve) - frequency;
        sum += error;
        least = std::min(least, error);
        most = std::max(most, error);
      }
      table.add({units.drawn(frequency), units.drawn(sum / kPhases), units.drawn(most - least)});
    }
  }
  return table;
}

Figure bias_and_ripple_figure(const certificates::ModelSets& sets, const model::TrackerModel& tracker,
                              const FrequencyUnits& units) {
  const rigor::NearestRounding nearest;
  const std::string unit = units.drawn_unit();
  std::string script = gnuplot_style(520);
  FigureTable cells = table_of_cells(sets.slices, units);
  FigureTable curve = table_on_curve(tracker, sets.starts.tubes.tubes, units);
  script += cells.block() + curve.block();
  script += fmt::format(
      "set xrange [{:.9g}:{:.9g}]\n"
      "set lmargin 13\nset rmargin 3\nset format y '%.3g'\n"
      "set multiplot layout 2,1\n"
      "set offsets 0, 0, graph 0.1, graph 0.1\n"
      "set ylabel 'bias, {}' offset -1.5\n"
      "plot $cells using 1:2:3 with filledcurves fc rgb '#d0d0d0' title 'bias, proved to be between', "
      "'' using 1:2 with lines lw 1 lc rgb '#888888' notitle, '' using 1:3 with lines lw 1 lc rgb '#888888' "
      "notitle, $curve using 1:2 with lines lw 1.6 dt 2 lc rgb '#000000' title 'computed, not proved'\n"
      "set yrange [0:*]\nset offsets 0, 0, graph 0.1, 0\n"
      "set xlabel 'frequency of the signal, {}'\n"
      "set ylabel 'ripple, {}' offset -1.5\n"
      "plot $cells using 1:4 with lines lw 1.6 lc rgb '#000000' title 'ripple, proved to be at most', "
      "$curve using 1:3 with lines lw 1.6 dt 2 lc rgb '#000000' title 'computed, not proved'\n"
      "unset multiplot\n",
      units.drawn(sets.slices.front().low), units.drawn(sets.slices.back().high), unit, unit, unit);
  return {"bias.svg",
          fmt::format("Bias (above) and ripple (below) of the frequency estimate in the long run, without "
                      "noise, {}, against the frequency of the signal. The bias is proved to be in the grey "
                      "band, the ripple to be below the solid line; the dashed lines are computed from the "
                      "curve of the certificate in floating point and are not proved.",
                      unit),
          std::move(script),
          "Bias and ripple over the frequency of the signal",
          {std::move(cells), std::move(curve)}};
}

/// Adds how far each tube of a set reaches, proved as for the whole set.
void add_reach(const std::string& name, const ProvedSet& set, const model::TrackerModel& tracker,
               const FrequencyUnits& units, FigureTable& table) {
  const auto reach_of = [&](const ProvedTube& proved) {
    return 0.999 * bound_reach(tracker, proved.tube, proved.levels.front(), {});
  };
  for (const OverTube& tube : least_of_parts(set.tubes, reach_of)) {
    table.add({name, units.drawn(tube.low), units.drawn(tube.value)});
    table.add({name, units.drawn(tube.high), units.drawn(tube.value)});
  }
}

Figure reach_figure(const std::vector<std::pair<std::string, const ProvedSet*>>& sets,
                    const model::TrackerModel& tracker, const FrequencyUnits& units) {
  constexpr std::array<std::string_view, 4> kStyles{
      "lw 2 dt 1 lc rgb '#000000'", "lw 2 dt 2 lc rgb '#000000'", "lw 2 dt 3 lc rgb '#000000'",
      "lw 2 dt 4 lc rgb '#666666'"};
  double lowest = INFINITY;
  double highest = 0.0;
  for (const auto& [name, set] : sets) {
    const model::Tube& first = set->tubes.tubes.front().tube;
    const model::Tube& last = set->tubes.tubes.back().tube;
    lowest = std::min(lowest, first.frequency - first.half_width);
    highest = std::max(highest, last.frequency + last.half_width);
  }
  std::string script = gnuplot_style(360) +
                       fmt::format(
                           "set xlabel 'frequency of the signal, {}'\nset ylabel 'reach, {}'\nset xrange "
                           "[{:.9g}:{:.9g}]\nset yrange [0:*]\nset offsets 0, 0, graph 0.1, 0\n",
                           units.drawn_unit(), units.drawn_unit(), units.drawn(lowest), units.drawn(highest));
  std::string plot;
  FigureTable table(
      "reach", {"certified set", in_unit("frequency of the signal", units), in_unit("reach, proved", units)});
  for (std::size_t i = 0; i < sets.size(); ++i) {
    add_reach(sets[i].first, *sets[i].second, tracker, units, table);
    table.next_index();
    plot += fmt::format("{}$reach index {} using 2:3 with lines {} title '{}'", i == 0 ? "plot " : ", ", i,
                        kStyles.at(i), sets[i].first);
  }
  script += table.block();
  return {"reach.svg",
          fmt::format("How far the certified sets reach, {}, against the frequency of the signal: at every "
                      "phase a set contains states with a frequency error of that size. Proved for each cell "
                      "of frequencies{}.",
                      units.drawn_unit(),
                      sets.front().second->tubes.amplitudes.size() > 1
                          ? ", the least of all parts of the amplitudes"
                          : ""),
          script + plot + "\n",
          "How far the certified sets reach",
          {std::move(table)}};
}

/// The limit that each tube of a set tolerates on its own: a row for each end of its cell.
FigureTable table_of_own(const char* name, const char* quantity, const model::TubeSet& set,
                         double model::ProvedTube::*own, const FrequencyUnits& units) {
  FigureTable table(name, {in_unit("frequency of the signal", units), quantity});
  for (const OverTube& tube : least_of_parts(set, [own](const ProvedTube& proved) { return proved.*own; })) {
    table.add({units.drawn(tube.low), tube.value});
    table.add({units.drawn(tube.high), tube.value});
  }
  return table;
}

/// Whether it was looked for, cell by cell.
bool has_own(const std::optional<ProvedSet>& set, double model::ProvedTube::*own) {
  return set && (set->is_proved() || set->has_part()) &&
         std::all_of(set->tubes.tubes.begin(), set->tubes.tubes.end(),
                     [own](const ProvedTube& proved) { return proved.*own > 0.0; });
}

Figure tolerance_figure(const certificates::ModelSets& sets, const FrequencyUnits& units) {
  std::vector<FigureTable> data;
  std::vector<std::string> labels;
  double lowest = INFINITY;
  double highest = 0.0;
  const auto cover = [&](const model::TubeSet& set) {
    const model::Tube& first = set.tubes.front().tube;
    const model::Tube& last = set.tubes.back().tube;
    lowest = std::min(lowest, first.frequency - first.half_width);
    highest = std::max(highest, last.frequency + last.half_width);
  };
  if (has_own(sets.noise, &ProvedTube::own_noise)) {
    data.push_back(table_of_own("noise", "noise tolerated, proved [signal units]", sets.noise->tubes,
                                &ProvedTube::own_noise, units));
    labels.emplace_back("noise, signal units");
    cover(sets.noise->tubes);
  }
  if (has_own(sets.slew, &ProvedTube::own_slew)) {
    data.push_back(table_of_own("slew", "slew tolerated in the cell, proved [rad/sample per sample]",
                                sets.slew->tubes, &ProvedTube::own_slew, units));
    labels.emplace_back("slew, rad/sample per sample");
    cover(sets.slew->tubes);
  }
  std::string script = gnuplot_style(data.size() > 1 ? 520 : 320);
  for (const FigureTable& table : data) {
    script += table.block();
  }
  script += fmt::format(
      "set xrange [{:.9g}:{:.9g}]\nset lmargin 13\nset rmargin 3\nset format y '%.3g'\nset yrange [0:*]\n"
      "set offsets 0, 0, graph 0.1, 0\nset multiplot layout {},1\n",
      units.drawn(lowest), units.drawn(highest), data.size());
  for (std::size_t i = 0; i < data.size(); ++i) {
    script += i + 1 == data.size()
                  ? fmt::format("set xlabel 'frequency of the signal, {}'\n", units.drawn_unit())
                  : std::string();
    script += fmt::format(
        "set ylabel '{}' offset -1.5\nplot ${} using 1:2 with lines lw 2 lc rgb '#000000' notitle\n",
        labels[i], data[i].name());
  }
  script += "unset multiplot\n";
  const std::string slew =
      "the slew that the tracker tolerates without noise as long as the frequency stays in one cell of "
      "frequencies";
  const std::string noise = "the noise that the tracker tolerates at a constant frequency";
  const std::string words = data.size() > 1                  ? "Above, " + noise + "; below, " + slew
                            : labels[0].starts_with("noise") ? "Noise: " + noise
                                                             : "Slew: " + slew;
  return {
      "tolerance.svg",
      words +
          ", against the frequency of the signal. Proved by tubes, for each cell of frequencies by itself; "
          "what tubes prove of the whole band is the least of them, or less.",
      std::move(script), "Noise and slew that are tolerated, over the frequency of the signal",
      std::move(data)};
}

}  // namespace

std::vector<Figure> draw_model_figures(const certificates::Certificate& certificate) {
  const rigor::UpwardRounding upward;
  const certificates::ModelTables& tables = model_tables(certificate.design);
  const certificates::ModelSets& sets = model_sets(certificate);
  const certificates::Model model = make_model(tables.model, tables.assume.signal);
  const model::TrackerModel tracker = proved_model(model, tables.assume);
  const FrequencyUnits units(tables.assume.sample_rate);
  std::vector<std::pair<std::string, const ProvedSet*>> proved;
  const auto add = [&](const char* name, const ProvedSet& set) {
    if (set.is_proved() || set.has_part()) {
      proved.emplace_back(name, &set);
    }
  };
  add("no noise", sets.starts);
  if (sets.assumed) {
    add(!(sets.assumed->tubes.slew > 0.0)    ? "assumed noise"
        : !(sets.assumed->tubes.noise > 0.0) ? "assumed slew"
                                             : "assumed noise and slew",
        *sets.assumed);
  }
  if (sets.noise) {
    add("largest noise", *sets.noise);
  }
  if (sets.slew) {
    add("largest slew", *sets.slew);
  }
  std::vector<Figure> figures;
  if (sets.gains) {
    if (sets.gains->gains) {
      const auto& rate = tables.assume.sample_rate;
      figures.push_back(response_figure(*sets.gains, units, rate ? rate->nearest : 1.0));
    }
    return figures;
  }
  if (!proved.empty()) {
    figures.push_back(reach_figure(proved, tracker, units));
    if (has_own(sets.noise, &ProvedTube::own_noise) || has_own(sets.slew, &ProvedTube::own_slew)) {
      figures.push_back(tolerance_figure(sets, units));
    }
    const bool has_assumed = sets.assumed && (sets.assumed->is_proved() || sets.assumed->has_part());
    if (has_assumed || sets.starts.is_proved() || sets.starts.has_part()) {
      figures.push_back(draw_tube(tracker, (has_assumed ? *sets.assumed : sets.starts).tubes, units));
    }
  }
  const auto is_known = [](const FrequencySlice& cell) {
    return rigor::is_finite(cell.bias) && std::isfinite(cell.ripple);
  };
  if (!sets.slices.empty() && std::all_of(sets.slices.begin(), sets.slices.end(), is_known)) {
    figures.push_back(bias_and_ripple_figure(sets, tracker, units));
  }
  return figures;
}

}  // namespace veritrack::reports
