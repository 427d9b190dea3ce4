#include "reports/recording/track_figure.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reports/gnuplot.hpp"
#include "reports/recording/chi_square.hpp"

namespace veritrack::reports {

namespace {

constexpr std::size_t kPlaces = 1024;

std::string cell(double value) {
  return std::isfinite(value) ? fmt::format(" {:.9g}", value) : " NaN";
}

/// time, mean, least, largest estimate, low and high end of two deviations, mean and largest NIS, tone share.
std::string data_block(const std::vector<TrackRow>& rows, const RecordingUnits& units) {
  std::string text = "$run << END\n";
  for (const TrackRow& row : rows) {
    const double mean = row.frequency.mean();
    // In a gap the deviation grows beyond what the picture is about.
    const double deviation = row.worst == TrackState::gap ? NAN : row.deviation.mean();
    text += fmt::format("{:.9g}", units.drawn_time(row.first + (row.last - row.first) / 2));
    text += cell(units.drawn(mean));
    text += cell(row.frequency.count > 0 ? units.drawn(row.frequency.least) : NAN);
    text += cell(row.frequency.count > 0 ? units.drawn(row.frequency.largest) : NAN);
    text += cell(units.drawn(mean - 2.0 * deviation));
    text += cell(units.drawn(mean + 2.0 * deviation));
    text += cell(row.nis.mean());
    text += cell(row.tone_share.count > 0 ? row.tone_share.least : NAN);
    text += "\n";
  }
  return text + "END\n";
}

std::string nis_panel(const TrackResult& result, const std::vector<TrackRow>& rows) {
  const double channels = result.channels;
  const double freedom = channels * static_cast<double>(rows.front().last - rows.front().first + 1);
  return fmt::format(
      "set logscale y\nset ylabel 'NIS'\nplot {:.6g} with lines lw 1 dt 2 lc rgb '#777777' title '95 % band, "
      "if right', {:.6g} with lines lw 1 dt 2 lc rgb '#777777' notitle, $run using 1:7 with lines lw 0.8 lc "
      "rgb '#000000' title 'mean of each row'\nunset logscale y\n",
      channels * mean_square_quantile(freedom, kNormal975),
      std::fmax(1e-6, channels * mean_square_quantile(freedom, -kNormal975)));
}

}  // namespace

std::string draw_track(const TrackReport& report) {
  const TrackResult& result = report.result;
  const RecordingUnits units(report.sample_rate);
  const std::vector<TrackRow> rows = joined(result.series.rows(), kPlaces);
  if (rows.empty() || result.start_count == 0) {
    return {};
  }
  const std::size_t panels = result.has_innovation ? 3 : 2;
  std::string script = gnuplot_style(260 * panels);
  script += data_block(rows, units);
  script += fmt::format(
      "set multiplot layout {},1\nset lmargin 12\nset xlabel '{}'\nset xrange [{:.9g}:{:.9g}]\n"
      "set ylabel '{}'\n",
      panels, units.drawn_time_unit(), units.drawn_time(rows.front().first),
      units.drawn_time(rows.back().last + 1), units.drawn_unit());
  script += "plot ";
  if (result.has_innovation) {
    script += "$run using 1:5:6 with filledcurves lc rgb '#dddddd' title 'two deviations', ";
  }
  script +=
      "$run using 1:3:4 with filledcurves lc rgb '#999999' title 'least to largest', $run using 1:2 with "
      "lines lw 1.2 lc rgb '#000000' title 'estimate'\n";
  if (result.has_innovation) {
    script += nis_panel(result, rows);
  }
  script += fmt::format(
      "set yrange [0:1.05]\nset ylabel 'lock indicator'\nplot {} with lines lw 1 dt 2 lc rgb '#777777' title "
      "'below: no lock', $run using 1:8 with lines lw 1.2 lc rgb '#000000' title 'share of the power in the "
      "tone'\nunset multiplot\n",
      kLockShare);
  return run_gnuplot(script);
}

}  // namespace veritrack::reports
