#include "analysis/model/set/set_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using rigor::Interval;

double width_of(const TubeRun& run) {
  return run.range.high - run.range.low;
}

}  // namespace

std::vector<TubeRun> runs_of(const std::vector<ProvedTube>& tubes, double low, double high) {
  const rigor::UpwardRounding upward;
  std::vector<TubeRun> runs;
  double known = 0.0;
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const Tube& tube = tubes[i].tube;
    const double from = (Interval(tube.frequency) - Interval(tube.half_width)).upper();
    const double to = (Interval(tube.frequency) + Interval(tube.half_width)).lower();
    const bool goes_on = !runs.empty() && from <= known && tube.turns == tubes[i - 1].tube.turns;
    if (!goes_on) {
      runs.push_back({i, i, {std::max(low, from), 0.0}});
    }
    known = goes_on ? std::max(known, to) : to;
    runs.back().end = i + 1;
    runs.back().range.high = std::min(high, known);
  }
  const auto is_nothing = [](const TubeRun& run) { return !(run.range.low < run.range.high); };
  runs.erase(std::remove_if(runs.begin(), runs.end(), is_nothing), runs.end());
  return runs;
}

const TubeRun& widest(const std::vector<TubeRun>& runs) {
  if (runs.empty()) {
    throw std::invalid_argument("no part of the band has tubes");
  }
  return *std::max_element(runs.begin(), runs.end(),
                           [](const TubeRun& a, const TubeRun& b) { return width_of(a) < width_of(b); });
}

void keep_widest_part(TubeSet& set, double low, double high) {
  std::stable_sort(set.tubes.begin(), set.tubes.end(), [](const ProvedTube& a, const ProvedTube& b) {
    return a.tube.frequency < b.tube.frequency;
  });
  const std::vector<TubeRun> runs = runs_of(set.tubes, low, high);
  set.is_complete = false;
  if (runs.empty()) {
    set.tubes.clear();
    return;
  }
  set.parts.reserve(runs.size());
  for (const TubeRun& run : runs) {
    set.parts.push_back(run.range);
  }
  const TubeRun kept = widest(runs);
  set.part = kept.range;
  set.is_complete = kept.range.low <= low && high <= kept.range.high;
  set.tubes.erase(set.tubes.begin() + static_cast<std::ptrdiff_t>(kept.end), set.tubes.end());
  set.tubes.erase(set.tubes.begin(), set.tubes.begin() + static_cast<std::ptrdiff_t>(kept.first));
}

void FailedCells::add(const std::string& reason, double low, double high) {
  if (!failures_.empty() && failures_.back().reason == reason &&
      failures_.back().range.high >= low * (1.0 - 1e-9)) {
    failures_.back().range.high = high;
    return;
  }
  failures_.push_back({reason, {low, high}});
}

std::vector<std::string> FailedCells::reasons() const {
  const rigor::NearestRounding nearest;
  std::vector<std::string> texts;
  texts.reserve(failures_.size());
  for (const Failure& failure : failures_) {
    texts.push_back(fmt::format("{} between {:.6g} and {:.6g} rad/sample", failure.reason, failure.range.low,
                                failure.range.high));
  }
  return texts;
}

}  // namespace veritrack::model
