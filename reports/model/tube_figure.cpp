#include "reports/model/tube_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "analysis/model/set/amplitude_parts.hpp"
#include "analysis/model/set/falsifier.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "reports/gnuplot.hpp"

namespace veritrack::reports {

namespace {

using certificates::FrequencyUnits;
using model::ProvedTube;

constexpr double kFullTurn = 2.0 * std::numbers::pi;

/// The tube that contains the frequency; of two, the first.
const ProvedTube& tube_at_frequency(const model::TubeSet& set, double frequency) {
  const auto found = std::find_if(set.tubes.begin(), set.tubes.end(), [&](const ProvedTube& proved) {
    return std::fabs(frequency - proved.tube.frequency) <= proved.tube.half_width;
  });
  return found != set.tubes.end() ? *found : set.tubes.front();
}

/// A tube at one frequency, seen as frequency errors.
class TubeSection {
 public:
  TubeSection(const model::TrackerModel& tracker, const model::Tube& tube, double frequency)
      : points_(tracker), tube_(tube, frequency), frequency_(frequency) {}

  /// The direction of xi, of length 1, in which the estimated frequency grows most on the curve.
  Eigen::VectorXd steepest(double phase, double radius) {
    tube_.at(phase, frame_);
    Eigen::VectorXd gradient(frame_.curve.size());
    const double change = 1e-4 * radius;
    for (Eigen::Index i = 0; i < gradient.size(); ++i) {
      const Eigen::VectorXd side = frame_.shape.col(i) * change;
      gradient[i] = points_.frequency(frame_.curve + side) - points_.frequency(frame_.curve - side);
    }
    const double length = gradient.norm();
    return length > 0.0 ? Eigen::VectorXd(gradient / length)
                        : Eigen::VectorXd::Unit(gradient.size(), gradient.size() - 1);
  }
  /// The frequency error at these coordinates.
  double error(double phase, const Eigen::VectorXd& coordinates) {
    tube_.at(phase, frame_);
    return points_.frequency(frame_.state(coordinates)) - frequency_;
  }

 private:
  model::PointTracker points_;
  model::PointTube tube_;
  model::PointFrame frame_;
  double frequency_;
};

/// The ends of the tube and of its lowest level over the phase, in turns.
FigureTable table_of_envelope(TubeSection& section, const ProvedTube& proved, const FrequencyUnits& units) {
  constexpr int kPhases = 120;
  const std::string unit = units.drawn_unit();
  FigureTable table(
      "envelope", {"phase of the signal [turns]", fmt::format("frequency error, whole tube, low [{}]", unit),
                   fmt::format("frequency error, whole tube, high [{}]", unit),
                   fmt::format("frequency error, lowest level, low [{}]", unit),
                   fmt::format("frequency error, lowest level, high [{}]", unit)});
  for (int j = 0; j <= kPhases; ++j) {
    const double phase = kFullTurn * j / kPhases;
    const Eigen::VectorXd direction = section.steepest(phase, proved.levels.front());
    std::vector<FigureTable::Cell> row{static_cast<double>(j) / kPhases};
    for (const double radius : {proved.levels.front(), proved.levels.back()}) {
      row.emplace_back(units.drawn(section.error(phase, -radius * direction)));
      row.emplace_back(units.drawn(section.error(phase, radius * direction)));
    }
    table.add(std::move(row));
  }
  return table;
}

/// "for noise of at most 0.02 signal units".
std::string tube_disturbances(const model::TubeSet& set, const FrequencyUnits& units) {
  const rigor::UpwardRounding upward;
  std::string text = set.noise > 0.0 ? fmt::format("for noise of at most {} signal units",
                                                   rigor::to_decimal(set.noise, 4, rigor::Direction::down))
                                     : std::string("without noise");
  if (set.slew > 0.0) {
    text += fmt::format("{} a slew of at most {}", set.noise > 0.0 ? " and" : ", for", units.slew(set.slew));
  }
  return text;
}

/// Adds the run, phases in turns; a turn is a line of the picture, from edge to edge.
void add_run(double number, const std::vector<model::AttackedSample>& run, const FrequencyUnits& units,
             FigureTable& table) {
  double last_place = 0.0;
  double last_error = 0.0;
  for (std::size_t k = 0; k < run.size(); ++k) {
    const double place = run[k].phase / kFullTurn;
    const double error = units.drawn(run[k].frequency_error);
    const double edge = std::floor(place);
    if (k > 0 && last_place < edge) {
      const double between = last_error + (error - last_error) * (edge - last_place) / (place - last_place);
      table.add({number, 1.0, between});
      table.gap();
      table.add({number, 0.0, between});
    }
    table.add({number, place - edge, error});
    last_place = place;
    last_error = error;
  }
  table.gap();
}

}  // namespace

namespace {

/// " and amplitudes from 0.99 to 1.01", of a part of the amplitudes.
std::string words_of_amplitudes(const model::TubeSet& set) {
  std::string text;
  for (const model::AmplitudePart& part : set.amplitudes) {
    text = fmt::format(" and amplitudes from {:.6g} to {:.6g}", part.low, part.high);
  }
  return text;
}

}  // namespace

Figure draw_tube(const model::TrackerModel& design, const model::TubeSet& all, const FrequencyUnits& units) {
  const rigor::NearestRounding nearest;
  // The middle one of several parts of the amplitudes.
  const std::vector<model::TubeSet> parts = model::sets_of_amplitudes(all);
  const model::TubeSet& set = parts[parts.size() / 2];
  const model::TrackerModel tracker = model::on_amplitudes_of(design, set);
  const model::Tube& first = set.tubes.front().tube;
  const model::Tube& last = set.tubes.back().tube;
  const double frequency = 0.5 * (first.frequency - first.half_width + last.frequency + last.half_width);
  const ProvedTube& proved = tube_at_frequency(set, frequency);
  TubeSection section(tracker, proved.tube, frequency);
  const bool varies = tracker.amplitude_varies;

  constexpr int kStarts = 4;
  constexpr int kSamples = 2000;
  const std::string unit = units.drawn_unit();
  const std::string error_column = fmt::format("frequency error, simulated [{}]", unit);
  FigureTable envelope = table_of_envelope(section, proved, units);
  FigureTable starts("starts", {"run", "phase of the signal [turns]", error_column});
  FigureTable errors("errors", {"run", "phase of the signal [turns]", error_column});
  for (int i = 0; i < kStarts; ++i) {
    const double phase = kFullTurn * (i + 0.5) / kStarts;
    const double radius = i % 2 == 0 ? proved.levels.front() : -proved.levels.front();
    const auto run = simulate_attack(tracker, proved.tube, {frequency, phase, set.noise, 0.0},
                                     radius * section.steepest(phase, proved.levels.front()), kSamples);
    add_run(i + 1, run, units, errors);
    starts.add({static_cast<double>(i + 1), phase / kFullTurn, units.drawn(run.front().frequency_error)});
  }
  std::string script = gnuplot_style(440) +
                       fmt::format(
                           "set xlabel 'phase of the signal, turns'\nset ylabel 'frequency error, {}'\n"
                           "set xrange [0:1]\nset xtics 0.25\n"
                           "set offsets 0, 0, graph 0.06, graph 0.06\n",
                           unit) +
                       envelope.block() + starts.block() + errors.block() +
                       "plot $errors using 2:3 with lines lw 0.7 lc rgb '#888888' title 'simulated', "
                       "$starts using 2:3 with points pt 7 ps 0.7 lc rgb '#000000' title 'starts', "
                       "$envelope using 1:2 with lines lw 2 lc rgb '#000000' title 'whole tube', "
                       "'' using 1:3 with lines lw 2 lc rgb '#000000' notitle, "
                       "'' using 1:4 with lines lw 2 dt 2 lc rgb '#000000' title 'lowest level', "
                       "'' using 1:5 with lines lw 2 dt 2 lc rgb '#000000' notitle\n";
  return {
      "tube.svg",
      fmt::format(
          "The certified tube at {:.6g} {}{}, {}: frequency error ({}) against the phase of the signal "
          "(turns). A start in the tube stays between the solid lines and ends between the dashed ones. "
          "Grey: {} simulated starts on the rim (dots), {} samples each{}. The lines are drawn in floating "
          "point, and the simulations prove nothing.",
          units.drawn(frequency), unit, words_of_amplitudes(set), tube_disturbances(set, units), unit,
          kStarts, kSamples,
          set.noise > 0.0
              ? std::string(", with the noise") + (varies ? " and the amplitude that push" : " that pushes") +
                    " outward most at every sample, at a constant frequency"
          : varies ? ", with the amplitude that pushes outward most at every sample"
                   : ""),
      std::move(script),
      "The certified tube, with simulated runs",
      {std::move(envelope), std::move(starts), std::move(errors)}};
}

}  // namespace veritrack::reports
