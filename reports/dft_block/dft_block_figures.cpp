#include "reports/dft_block/dft_block_figures.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "certificates/dft_block/dft_block_simulation.hpp"
#include "reports/gnuplot.hpp"
#include "reports/line_styles.hpp"

namespace veritrack::reports {

namespace {

Figure offset_error_figure(const certificates::Certificate& certificate, const theorems::Derivation& found,
                           bool is_gaussian) {
  const std::vector<certificates::BlockRun> runs = certificates::simulate_blocks(certificate);
  FigureTable of_runs("runs",
                      {"offset of the tone at the start [bins]", "block", "size of the offset error [bins]"});
  for (const certificates::BlockRun& run : runs) {
    for (std::size_t k = 0; k < run.offset_error.size(); ++k) {
      of_runs.add({run.offset, static_cast<double>(k + 1), run.offset_error[k]});
    }
    of_runs.next_index();
  }
  const double blocks = static_cast<double>(runs.front().offset_error.size());
  const double ever = theorems::find_quantity(found, "offset_error_bound").value.upper();
  std::string script = gnuplot_style(400) +
                       "set xlabel 'block'\nset ylabel 'offset error, bins'\nset yrange [0:*]\n" +
                       fmt::format("set xrange [1:{:.6g}]\n", blocks) + of_runs.block();
  script += fmt::format("plot {:.9g} with lines {} title '{}'", ever, line::kCertified,
                        is_gaussian ? "proved, until lock is lost" : "proved, in every block");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    script += fmt::format(", $runs index {} using 2:3 with lines {}{}", i, line::kSimulated,
                          i == 0 ? " title 'simulated'" : " notitle");
  }
  if (!is_gaussian) {
    script +=
        fmt::format(", {:.9g} with lines {} title 'proved, in the long run'",
                    theorems::find_quantity(found, "ultimate_offset_error").value.upper(), line::kLongRun);
  }
  std::vector<FigureTable> data;
  data.push_back(std::move(of_runs));
  const std::string seen =
      is_gaussian
          ? "Gaussian noise as assumed, starts with the assumed errors; below the bound (bold) that is "
            "exceeded "
            "with no more than the proved probability."
          : "noise of the assumed length in random directions, starts with the assumed errors; below what is "
            "proved for every block (bold) and in the long run (dash-dotted).";
  return {
      "offset-error.svg",
      "Size of the offset error in three simulated runs (thin): tones at both ends and in the middle of the "
      "assumed offsets that move as fast as assumed, " +
          seen + " The simulations prove nothing.",
      script + "\n", "Offset error, simulated, below the proved bounds", std::move(data)};
}

/// Runs that end in lock, and runs that do not.
Figure false_lock_figure(const certificates::Certificate& certificate) {
  constexpr double kReach = 1.5;
  constexpr int kBlocks = 100;
  const certificates::StartsOnATone starts =
      certificates::simulate_starts(certificate, kReach, 12, 3, kBlocks);
  FigureTable table("runs", {"start", "block", "offset error [bins]"});
  for (std::size_t i = 0; i < starts.runs.size(); ++i) {
    for (std::size_t k = 0; k < starts.runs[i].size(); ++k) {
      table.add({static_cast<double>(i + 1), static_cast<double>(k), starts.runs[i][k]});
    }
    table.gap();
  }
  std::string script = gnuplot_style(420) + "set xlabel 'block'\nset ylabel 'offset error, bins'\n" +
                       fmt::format("set xrange [0:{}]\nset yrange [-2.2:2.2]\n", kBlocks) + table.block() +
                       fmt::format(
                           "plot $runs using 2:3 with lines {} title 'simulated', 0 with lines {} title "
                           "'exact lock'",
                           line::kSimulated, line::kLongRun);
  bool is_first = true;
  for (const char* id : {"false-lock-below", "false-lock-above"}) {
    const theorems::Derivation* found = certificates::find_derivation(certificate, id);
    if (found != nullptr && found->verdict == rigor::Verdict::proved) {
      script += fmt::format(", {:.9g} with lines {}{}",
                            rigor::midpoint(theorems::find_quantity(*found, "fixed_offset_error").value),
                            line::kCertified, is_first ? " title 'proved false lock'" : " notitle");
      is_first = false;
    }
  }
  std::vector<FigureTable> data;
  data.push_back(std::move(table));
  return {"false-locks.svg",
          fmt::format(
              "Offset error over the blocks from {} starts up to {} bins off at three phases (thin), for a "
              "tone of amplitude {:.4g} that is {:.4g} bins off, without noise; the exact lock (dash-dotted) "
              "and the false locks that are proved (bold). The simulations prove nothing.",
              starts.runs.size(), kReach, starts.amplitude, starts.offset),
          script + "\n", "Runs that end in lock and in false locks", std::move(data)};
}

}  // namespace

std::vector<Figure> draw_dft_block_figures(const certificates::Certificate& certificate) {
  std::vector<Figure> figures;
  for (const char* id : {"lock-set", "lock-in-noise"}) {
    const theorems::Derivation* found = certificates::find_derivation(certificate, id);
    if (found != nullptr && found->verdict == rigor::Verdict::proved) {
      figures.push_back(offset_error_figure(certificate, *found, found->id == "lock-in-noise"));
    }
  }
  if (certificates::find_derivation(certificate, "false-lock-below") != nullptr) {
    figures.push_back(false_lock_figure(certificate));
  }
  return figures;
}

}  // namespace veritrack::reports
