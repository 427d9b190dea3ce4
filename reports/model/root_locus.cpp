#include "reports/model/root_locus.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "analysis/linear/loop_response.hpp"
#include "certificates/design/request_error.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/document/output_files.hpp"
#include "certificates/model/model_design.hpp"
#include "reports/gnuplot.hpp"
#include "reports/page/renderings.hpp"

namespace veritrack::reports {

namespace {

using certificates::RootLocus;
namespace markdown = certificates::markdown;

/// Samples in which an error shrinks by a factor of e; NaN where it grows.
double decay_of(const std::complex<double>& multiplier) {
  return std::abs(multiplier) < 1.0 ? linear::mode_of(multiplier).time_constant : NAN;
}

FigureTable numbers_of(const RootLocus& locus) {
  FigureTable table("modes", {locus.parameter, "real part of the multiplier, not proved",
                              "imaginary part of the multiplier, not proved", "time constant [samples]"});
  for (const RootLocus::Point& point : locus.points) {
    for (const std::complex<double>& each : point.multipliers) {
      table.add({point.value, each.real(), each.imag(), decay_of(each)});
    }
  }
  return table;
}

/// The multipliers at the point of the table nearest to the design's value.
FigureTable given_of(const RootLocus& locus) {
  FigureTable table("given", {locus.parameter, "real part", "imaginary part", "time constant [samples]"});
  const RootLocus::Point* nearest = &locus.points.front();
  for (const RootLocus::Point& point : locus.points) {
    if (std::fabs(point.value - locus.given) < std::fabs(nearest->value - locus.given)) {
      nearest = &point;
    }
  }
  const bool is_inside =
      locus.points.front().value <= locus.given && locus.given <= locus.points.back().value;
  for (const std::complex<double>& each : nearest->multipliers) {
    if (is_inside) {
      table.add({nearest->value, each.real(), each.imag(), decay_of(each)});
    }
  }
  return table;
}

std::string time_constant_of(const RootLocus::Point& point) {
  if (point.multipliers.empty()) {
    return "no steady state found";
  }
  const double size = std::abs(point.multipliers.front());
  return size >= 1.0 ? "unstable" : fmt::format("{:.4g}", -1.0 / std::log(size));
}

/// The least of all modes, as in the certificate.
std::string damping_of(const RootLocus::Point& point) {
  double least = 1.0;
  for (const std::complex<double>& each : point.multipliers) {
    least = std::min(least, linear::mode_of(each).damping);
  }
  return point.is_stable() ? fmt::format("{:.3g}", least) : "";
}

std::string table_of(const RootLocus& locus) {
  constexpr std::size_t kEach = 6;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < locus.points.size(); i += kEach) {
    const RootLocus::Point& point = locus.points[i];
    rows.push_back(
        {fmt::format("{:.5g}", point.value),
         point.multipliers.empty() ? "" : fmt::format("{:.6g}", std::abs(point.multipliers.front())),
         time_constant_of(point)});
    if (locus.is_in_frame) {
      rows.back().push_back(damping_of(point));
    }
  }
  std::vector<std::string> titles{fmt::format("`{}`", locus.parameter), "Largest multiplier, its size",
                                  "Slowest time constant, samples"};
  if (locus.is_in_frame) {
    titles.emplace_back("Least damping ratio");
  }
  return markdown::table(titles, rows);
}

std::string circle_panel(const RootLocus& locus) {
  return fmt::format(
      "set parametric\nset trange [0:2*pi]\nset size ratio -1\nset xlabel 'real part'\nset ylabel 'imaginary "
      "part'\nset xrange [-1.25:1.25]\nset yrange [-1.25:1.25]\nset cbrange [{}:{}]\nunset colorbox\n"
      "set palette gray negative\n"
      "plot cos(t), sin(t) with lines lw 1 dt 3 lc rgb '#888888' notitle, "
      "$modes using 2:3:1 with points pt 7 ps 0.45 lc palette notitle, "
      "$given using 2:3 with points pt 2 ps 1.4 lw 2 lc rgb '#000000' notitle\n"
      "unset parametric\nset size noratio\nset autoscale\n",
      locus.points.front().value - 0.35 * (locus.points.back().value - locus.points.front().value),
      locus.points.back().value);
}

std::string size_panel(const RootLocus& locus) {
  return fmt::format(
      "set xlabel {}\nset ylabel 'time constant, samples'\n{}set xrange [{}:{}]\nset yrange [0.5:*]\n"
      "set logscale y\nset format y '%.3g'\n"
      "plot $modes using 1:4 with points pt 7 ps 0.4 lc rgb '#000000' notitle, "
      "$given using 1:4 with points pt 2 ps 1.4 lw 2 lc rgb '#000000' notitle\n",
      gnuplot_text(locus.parameter), locus.points.front().value > 0.0 ? "set logscale x\n" : "",
      locus.points.front().value, locus.points.back().value);
}

}  // namespace

Figure root_locus_figure(const RootLocus& locus) {
  FigureTable modes = numbers_of(locus);
  FigureTable given = given_of(locus);
  std::string script = gnuplot_style(locus.is_in_frame ? 460 : 420);
  script += modes.block() + given.block() + "set lmargin 10\nset rmargin 3\n";
  // gnuplot draws no axes for nothing: where no mode decays at any value, the plane is all.
  const bool decays =
      std::any_of(locus.points.begin(), locus.points.end(), [](const RootLocus::Point& point) {
        return !point.multipliers.empty() && std::abs(point.multipliers.back()) < 1.0;
      });
  script += fmt::format("set multiplot layout 1,{}\n", locus.is_in_frame && decays ? 2 : 1);
  script += locus.is_in_frame ? circle_panel(locus) : "";
  script += decays ? size_panel(locus) : "";
  script += "unset multiplot\n";
  std::string caption = fmt::format(
      "Computed, not proved: by what each mode of the errors is multiplied at a sample, and how fast it "
      "decays, for {} from {:.4g} "
      "to "
      "{:.4g}. ",
      locus.parameter, locus.points.front().value, locus.points.back().value);
  caption += locus.is_in_frame
                 ? "Left, in the plane, the darker the larger the value, with the unit circle; right, "
                   "the time constant of each mode that decays; those below half a sample are left out. "
                 : "Shown is the time constant of each mode; those below half a sample are left out. ";
  caption += "Crosses: at the value nearest to that of the design.";
  return {"root-locus.svg",
          std::move(caption),
          std::move(script),
          "Modes of the errors over " + locus.parameter,
          {std::move(modes)}};
}

std::string stable_values(const RootLocus& locus) {
  std::vector<std::string> texts;
  for (const RootLocus::Range& range : locus.stable) {
    texts.push_back(fmt::format("{:.4g} to {:.4g}", range.from, range.to));
  }
  return texts.empty() ? "at none of these values" : fmt::format("from {}", fmt::join(texts, ", "));
}

std::string root_locus_document(const certificates::Design& design, const RootLocus& locus,
                                const Figure& figure) {
  const certificates::ModelTables& tables = certificates::model_tables(design);
  const certificates::FrequencyUnits units(tables.assume.sample_rate);
  const std::string at =
      fmt::format("{:.6g} rad/sample{}", locus.frequency,
                  units.has_hertz() ? fmt::format(" ({:.6g} Hz)", units.drawn(locus.frequency)) : "");
  std::string text =
      fmt::format("# Stable for `{}` {} (computed, not proved)\n\n", locus.parameter, stable_values(locus));
  text += fmt::format(
      "The linear loop of {}, on a tone of {} without noise, with `{}` from {:.5g} to {:.5g} and the other "
      "parameters as they are. The design has {:.6g}. ",
      markdown::escaped(design.name), at, locus.parameter, locus.points.front().value,
      locus.points.back().value, locus.given);
  text += !locus.is_in_frame ? "The errors depend on the phase of the signal: known is how fast each mode "
                               "decays, and not how it "
                               "turns.\n\n"
          : locus.is_average
              ? "On the average over the phase: what turns with the signal is left out. The faster the loop, "
                "the less of this is true.\n\n"
              : "The loop does not depend on the phase at which its signal begins.\n\n";
  text += certificates::picture({figure.file, figure.title, figure.caption});
  text += table_of(locus);
  text +=
      "\n`veritrack certify` proves whether the loop of the design is stable, and what it tolerates. "
      "`root-locus.csv` has all values.\n";
  return text;
}

MapResult write_root_locus(const certificates::Design& design, const MapRequest& request,
                           const std::filesystem::path& directory) {
  if (request.at || request.x || request.y || request.x_range || request.y_range || request.cells ||
      request.with_noise) {
    throw certificates::RequestError(
        "--over draws the modes at the middle of the band, without noise; allowed beside it: --out, --html");
  }
  const RootLocus locus = certificates::root_locus(certificates::model_tables(design), request.over.value());
  const Figure figure = with_picture(root_locus_figure(locus));
  page::Document document{"root-locus", root_locus_document(design, locus, figure)};
  document.figures = {figure};
  certificates::OutputFiles files;
  stage_document(files, directory, document, {request.html, false, false});
  files.stage(directory / "root-locus.csv", figure.data.front().csv());
  files.commit();
  return {directory / "root-locus.md",
          fmt::format("not proved: stable for {} {}", locus.parameter, stable_values(locus))};
}

}  // namespace veritrack::reports
