#include "reports/recording/track_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "reports/figure_table.hpp"
#include "reports/gnuplot.hpp"
#include "reports/line_styles.hpp"

namespace veritrack::reports {

namespace {

using certificates::TrackedBlock;
using State = TrackedBlock::State;

const char* name_of(State state) {
  switch (state) {
    case State::lock:
      return "lock";
    case State::false_lock:
      return "false-lock";
    case State::no_tone:
      return "no-tone";
    case State::settling:
      break;
  }
  return "settling";
}

std::size_t count_of(const TrackResult& result, State state) {
  return static_cast<std::size_t>(
      std::count_if(result.blocks.begin(), result.blocks.end(),
                    [state](const TrackedBlock& one) { return one.state == state; }));
}

}  // namespace

std::string block_lock_sentence(const TrackResult& result, const RecordingUnits& units) {
  const std::size_t settling = count_of(result, State::settling);
  const std::size_t judged = result.blocks.size() - settling;
  if (judged == 0) {
    return fmt::format("Too few blocks to judge the lock: {}.", result.blocks.size());
  }
  const std::size_t in_false = count_of(result, State::false_lock);
  if (in_false > 0) {
    const auto first = std::find_if(result.blocks.begin(), result.blocks.end(),
                                    [](const TrackedBlock& one) { return one.state == State::false_lock; });
    return fmt::format(
        "The lock is FALSE in {} of {} blocks, first in block {}: the estimate is {}, while {} explains "
        "{:.3g} % of "
        "the power.",
        in_false, judged, first - result.blocks.begin() + 1, units.frequency(first->frequency),
        units.frequency(first->best_frequency), 100.0 * first->best_share);
  }
  const std::size_t without = count_of(result, State::no_tone);
  return without == 0 ? std::string("Kept lock.")
         : without == judged
             ? std::string("No tone was seen in the tracker's bins.")
             : fmt::format("No tone was seen in {} of {} blocks, else in lock.", without, judged);
}

bool blocks_are_in_lock(const TrackResult& result) {
  const std::size_t in_lock = count_of(result, State::lock);
  return in_lock > 0 && in_lock + count_of(result, State::settling) == result.blocks.size();
}

std::string blocks_section(const TrackReport& report, const std::string& figure) {
  const TrackResult& result = report.result;
  std::string text = fmt::format(
      "## Blocks\n\n{} blocks of {} samples. The estimate leaves a share of the power of a block's bins "
      "unexplained: that of the noise in lock, and nearly all in a false lock, about a whole number of bins "
      "off. "
      "Over about 20 blocks, with weights that fall: a tone is there when some offset explains at least "
      "1/(2L + 1) + "
      "0.25 of the power, and then the lock is *false* when the estimate explains less than half of what the "
      "best "
      "offset does. In lock: {} blocks; false: {}; no tone: {}; too early to tell: {}. A tracker in a false "
      "lock stays "
      "there: start it again, at the offset that explains most.\n\n",
      result.blocks.size(), result.blocks.front().samples, count_of(result, State::lock),
      count_of(result, State::false_lock), count_of(result, State::no_tone),
      count_of(result, State::settling));
  if (!figure.empty()) {
    text += fmt::format("![Share of the power that the estimate leaves unexplained]({})\n\n", figure);
  }
  return text + "`blocks.csv` has a row for each block.\n\n";
}

std::string blocks_table(const TrackResult& result) {
  std::string text =
      "block,frequency [rad/sample],unexplained share,unexplained share over the last blocks,best frequency "
      "[rad/sample],share that it explains,state\r\n";
  for (std::size_t i = 0; i < result.blocks.size(); ++i) {
    const TrackedBlock& one = result.blocks[i];
    text += fmt::format("{},{:.10g},{:.6g},{:.6g},{:.10g},{:.6g},{}\r\n", i + 1, one.frequency,
                        one.unexplained_share, one.last_blocks_share, one.best_frequency, one.best_share,
                        name_of(one.state));
  }
  return text;
}

std::string draw_blocks(const TrackResult& result) {
  FigureTable table("blocks", {"block", "unexplained", "over the last blocks", "the best leaves"});
  for (std::size_t i = 0; i < result.blocks.size(); ++i) {
    const TrackedBlock& one = result.blocks[i];
    table.add(
        {static_cast<double>(i + 1), one.unexplained_share, one.last_blocks_share, 1.0 - one.best_share});
  }
  return run_gnuplot(
      gnuplot_style(380) + "set xlabel 'block'\nset ylabel 'share of the power that is left unexplained'\n" +
      fmt::format("set xrange [1:{}]\nset yrange [-0.05:1.25]\n",
                  std::max<std::size_t>(result.blocks.size(), 2)) +
      table.block() +
      fmt::format(
          "plot $blocks using 1:2 with lines {} title 'by the estimate', '' using 1:3 with lines {} title "
          "'by the estimate, last blocks', '' using 1:4 with lines {} title 'by the best offset, last "
          "blocks'\n",
          line::kSimulated, line::kCertified, line::kAssumed));
}

}  // namespace veritrack::reports
