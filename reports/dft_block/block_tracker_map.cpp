#include "reports/dft_block/block_tracker_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "certificates/dft_block/dft_block_design.hpp"
#include "certificates/dft_block/dft_block_simulation.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/document/output_files.hpp"
#include "reports/gnuplot.hpp"
#include "reports/page/renderings.hpp"

namespace veritrack::reports {

namespace {

using certificates::Certificate;
using certificates::StartsOnATone;
namespace markdown = certificates::markdown;

constexpr int kMapBlocks = 400;
constexpr double kTurn = 6.283185307179586;

/// By where a start ends: in lock, too low, too high, not settled.
enum class End : std::size_t { lock, below, above, elsewhere };
constexpr std::array kEndNames{"lock", "below", "above", "elsewhere"};

End end_of(const std::vector<double>& run) {
  const double last = run.back();
  constexpr double kLock = 0.01;
  constexpr double kStill = 1e-3;
  if (std::fabs(last) < kLock) {
    return End::lock;
  }
  const double before = run[run.size() - 20];
  if (!(std::fabs(last - before) < kStill) || std::fabs(last) < 0.5) {
    return End::elsewhere;
  }
  return last < 0.0 ? End::below : End::above;
}

/// Where the set about the exact lock ends, over offset and phase errors, for x1 without error: |C^-1 (0,
/// phase, offset)| = radius, in floating point.
FigureTable edge_of(const Certificate& certificate) {
  FigureTable edge("edge", {"offset error [bins]", "phase error [rad]"});
  for (const char* id : {"lock-set", "lock-in-noise"}) {
    const theorems::Derivation* found = certificates::find_derivation(certificate, id);
    if (found == nullptr || found->verdict != rigor::Verdict::proved) {
      continue;
    }
    double radius = 0.0;
    for (const auto& [name, value] : found->evidence.front().numbers) {
      radius = name == "radius" ? value : radius;
    }
    // C is lower triangular, so that e_1 = 0 and only its lower block counts.
    const auto& frame = found->evidence.front().matrices.front().second;
    constexpr int kPoints = 120;
    for (int i = 0; i <= kPoints; ++i) {
      const double u = radius * std::cos(kTurn * i / kPoints);
      const double v = radius * std::sin(kTurn * i / kPoints);
      edge.add({frame(2, 1) * u + frame(2, 2) * v, frame(1, 1) * u + frame(1, 2) * v});
    }
  }
  return edge;
}

Figure draw_map(const Certificate& certificate, const StartsOnATone& starts, int columns, int rows,
                double reach) {
  FigureTable table("starts", {"offset error at the start [bins]", "phase error at the start [rad]",
                               "offset error after 400 blocks [bins]", "ends"});
  std::string script =
      gnuplot_style(600) +
      fmt::format(
          "set tics out\nunset grid\nset xlabel 'offset error at the start, bins'\nset ylabel 'phase error "
          "at the middle of the first block, rad'\nset xrange [{0:.9g}:{1:.9g}]\nset yrange [-{2}:{2}]\n",
          -reach, reach, 0.5 * kTurn);
  const double across = reach / columns;
  const double up = 0.5 * kTurn / rows;
  std::array<FigureTable, 4> ends{FigureTable("lock", {"x", "y"}), FigureTable("below", {"x", "y"}),
                                  FigureTable("above", {"x", "y"}), FigureTable("elsewhere", {"x", "y"})};
  for (std::size_t i = 0; i < starts.runs.size(); ++i) {
    const auto end = static_cast<std::size_t>(end_of(starts.runs[i]));
    ends.at(end).add({starts.offset_errors[i], starts.phase_errors[i]});
    table.add({starts.offset_errors[i], starts.phase_errors[i], starts.runs[i].back(),
               std::string(kEndNames.at(end))});
  }
  for (const FigureTable& one : ends) {
    script += one.block();
  }
  FigureTable edge = edge_of(certificate);
  script += edge.block();
  std::string plot = fmt::format(
      "plot $lock using 1:2:({0:.9g}):({1:.9g}) with boxxyerror fillcolor rgb '#8e8e8e' fs solid 1.0 border "
      "lc rgb "
      "'#8e8e8e' lw 0.5 title 'in lock', $below using 1:2:({0:.9g}):({1:.9g}) with boxxyerror fillcolor rgb "
      "'#777777' "
      "fs pattern 4 noborder title 'too low', $above using 1:2:({0:.9g}):({1:.9g}) with boxxyerror fillcolor "
      "rgb "
      "'#777777' fs pattern 5 noborder title 'too high', $elsewhere using 1:2 with points pt 7 ps 0.3 lc rgb "
      "'#000000' title 'not settled', $edge using 1:2 with lines lw 4 lc rgb '#ffffff' notitle, '' using 1:2 "
      "with "
      "lines lw 1.8 lc rgb '#000000' title 'certified set about the exact lock'",
      across, up);
  FigureTable sets("sets", {"offset error [bins]", "phase error [rad]"});
  for (const char* id : {"false-lock-below", "false-lock-above"}) {
    const theorems::Derivation* found = certificates::find_derivation(certificate, id);
    if (found != nullptr && found->verdict == rigor::Verdict::proved) {
      const auto& centre = found->evidence.front().matrices.front().second;
      sets.add({centre(0, 2), std::remainder(centre(0, 1), kTurn)});
    }
  }
  script += sets.block();
  plot +=
      ", $sets using 1:2 with points pt 7 ps 1.6 lc rgb '#ffffff' notitle, '' using 1:2 with points pt 6 ps "
      "1.6 lw 2 lc "
      "rgb '#000000' title 'certified false lock'\n";
  std::vector<FigureTable> data;
  data.push_back(std::move(table));
  return {
      "starts.svg",
      fmt::format(
          "Where starts end, over offset and phase error of the first prediction, for a tone of amplitude "
          "{:.4g} that is {:.4g} bins off, without noise; amplitude of the start exact, covariance that of "
          "the steady state: simulated, {} starts, {} blocks. Line: the edge of the certified set about "
          "the exact lock, in floating point. Circles: certified sets of false locks, which are smaller "
          "than the circle and have another amplitude and covariance than the starts.",
          starts.amplitude, starts.offset, starts.runs.size(), kMapBlocks),
      script + plot, "Where starts end", std::move(data)};
}

}  // namespace

MapResult write_block_tracker_map(const certificates::Design& design, const MapRequest& request,
                                  const std::filesystem::path& directory,
                                  const certificates::CertifyProgress& progress) {
  const Certificate certificate = certificates::certify(design, "", "", progress);
  constexpr int kDefaultCells = 61;
  constexpr double kReach = 2.0;
  const int columns = request.cells.value_or(kDefaultCells);
  const int rows = (2 * columns) / 3 + 1;
  const StartsOnATone starts = certificates::simulate_starts(certificate, kReach, columns, rows, kMapBlocks);
  std::array<std::size_t, 4> counts{};
  for (const auto& run : starts.runs) {
    ++counts.at(static_cast<std::size_t>(end_of(run)));
  }
  const Figure figure = with_picture(draw_map(certificate, starts, columns, rows, kReach));
  const auto share = [&](std::size_t count) {
    return fmt::format("{:.1f} %",
                       100.0 * static_cast<double>(count) / static_cast<double>(starts.runs.size()));
  };
  std::string text = fmt::format("# Where starts end: {}\n\n", markdown::escaped(design.name));
  for (const certificates::Claim& claim : certificate.claims) {
    if (!claim.required && claim.verdict != rigor::Verdict::undecided) {
      text += fmt::format("{}: {}\n\n", markdown::verdict(claim.verdict), claim.statement);
    }
  }
  text +=
      "## The starts\n\n" +
      markdown::table(
          {"Shown", "Ends", "Starts", "Share"},
          {{"grey", "on the tone", std::to_string(counts[0]), share(counts[0])},
           {"hatched", "about one bin or more too low", std::to_string(counts[1]), share(counts[1])},
           {"hatched the other way", "about one bin or more too high", std::to_string(counts[2]),
            share(counts[2])},
           {"dots", fmt::format("not settled after {} blocks", kMapBlocks), std::to_string(counts[3]),
            share(counts[3])}}) +
      "\n*Sampled*: the counts are of simulations in double precision, which prove nothing.\n\n" +
      certificates::picture({figure.file, figure.title, figure.caption}) +
      "`veritrack track` tells from a recording whether a lock is false; `docs/block-tracker.md`, section 6, "
      "says how.\n";
  page::Document document{"map", text};
  document.figures = {figure};
  certificates::OutputFiles files;
  stage_document(files, directory, document, {request.html, true, false});
  files.commit();
  return {directory / "map.md",
          fmt::format(
              "simulated: {} of the starts end on the tone, {} too low, {} too high; proved: {} false locks",
              share(counts[0]), share(counts[1]), share(counts[2]),
              std::count_if(certificate.derivations.begin(), certificate.derivations.end(),
                            [](const theorems::Derivation& one) {
                              return one.id.starts_with("false-lock") &&
                                     one.verdict == rigor::Verdict::proved;
                            }))};
}

}  // namespace veritrack::reports
