#include "reports/dft_block/dft_block_figures.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "certificates/dft_block/dft_block_simulation.hpp"
#include "reports/gnuplot.hpp"
#include "reports/line_styles.hpp"

namespace veritrack::reports {

std::vector<Figure> draw_dft_block_figures(const certificates::Certificate& certificate) {
  const theorems::Derivation& found = *certificates::find_derivation(certificate, "lock-set");
  if (found.verdict != rigor::Verdict::proved) {
    return {};
  }
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
  const double last = theorems::find_quantity(found, "ultimate_offset_error").value.upper();
  std::string script = gnuplot_style(400) +
                       "set xlabel 'block'\nset ylabel 'offset error, bins'\nset yrange [0:*]\n" +
                       fmt::format("set xrange [1:{:.6g}]\n", blocks) + of_runs.block();
  script += fmt::format("plot {:.9g} with lines {} title 'proved, in every block'", ever, line::kCertified);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    script += fmt::format(", $runs index {} using 2:3 with lines {}{}", i, line::kSimulated,
                          i == 0 ? " title 'simulated'" : " notitle");
  }
  script += fmt::format(", {:.9g} with lines {} title 'proved, in the long run'", last, line::kLongRun);
  std::vector<FigureTable> data;
  data.push_back(std::move(of_runs));
  return {
      {"offset-error.svg",
       "Size of the offset error in three simulated runs (thin): tones at both ends and in the middle of the "
       "assumed "
       "offsets that move as fast as assumed, noise of the assumed length in random directions, starts with "
       "the "
       "assumed errors; below what is proved for every block (bold) and in the long run (dash-dotted). The "
       "simulations prove nothing.",
       run_gnuplot(script + "\n"), "Offset error, simulated, below the proved bounds", std::move(data)}};
}

}  // namespace veritrack::reports
