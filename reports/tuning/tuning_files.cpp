#include "reports/tuning/tuning_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "certificates/document/markdown_text.hpp"
#include "certificates/document/output_files.hpp"
#include "reports/gnuplot.hpp"
#include "reports/tuning/trade_off_figure.hpp"

namespace veritrack::reports {

namespace {

using certificates::TradeOff;
using certificates::TriedDesign;
using Role = TriedDesign::Role;
namespace markdown = certificates::markdown;

const char* role_words(Role role) {
  switch (role) {
    case Role::given:
      return "given";
    case Role::chosen:
      return "chosen";
    case Role::trade_off:
      return "trade-off";
    case Role::tried:
      break;
  }
  return "tried";
}

std::string response_words(const TriedDesign& design) {
  return design.response ? std::to_string(*design.response) : "";
}

std::string value_words(const TriedDesign& design) {
  return design.value ? fmt::format("{:.4g}", *design.value) : "";
}

/// Given, chosen and the line of the figure, by response.
std::string trade_off_table(const TradeOff& trade_off) {
  std::vector<TriedDesign> shown;
  std::copy_if(trade_off.designs.begin(), trade_off.designs.end(), std::back_inserter(shown),
               [](const TriedDesign& design) { return design.role != Role::tried; });
  std::stable_sort(shown.begin(), shown.end(), [](const TriedDesign& a, const TriedDesign& b) {
    return a.response.value_or(1 << 30) < b.response.value_or(1 << 30);
  });
  std::vector<std::vector<std::string>> rows;
  for (const TriedDesign& design : shown) {
    std::vector<std::string> row{role_words(design.role)};
    for (const auto& [key, value] : design.values) {
      row.push_back(value);
    }
    row.push_back(design.response ? response_words(design) : "—");
    row.push_back(design.value ? "≈ " + value_words(design) : "—");
    row.emplace_back(design.meets ? "yes" : "no");
    rows.push_back(std::move(row));
  }
  return markdown::table({"Design", "q1", "q2", "r", "epsilon", "Response, samples",
                          "Objective, " + trade_off.unit, "All that is required"},
                         rows);
}

std::string list_of(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) {
    text += "- " + markdown::escaped(sentence) + "\n";
  }
  return text + "\n";
}

}  // namespace

std::string tuning_document(const certificates::TuningResult& result, const std::string& tuned_name,
                            const std::string& caption) {
  const TradeOff& trade_off = result.trade_off.value();
  std::string text = fmt::format("# How the values of {} were chosen\n\n", markdown::escaped(tuned_name));
  text += list_of(result.notes);
  if (!result.changes.empty()) {
    text += "## What would have to change\n\n" + list_of(result.changes);
  }
  text += "## What the search saw\n\n";
  if (!caption.empty()) {
    text += fmt::format("![{0}](figures/trade-off.svg)\n\n*{0}*\n\n", caption);
  }
  text += trade_off_table(trade_off) + "\n";
  text += fmt::format(
      "Objective: {}. {}The response is the number of samples in which a small step of the frequency is "
      "followed to within a tenth, simulated without noise.\n\nA local search (Sbplx, from NLopt) went from "
      "the "
      "given values, or from those of the Kalman filter for the assumed noise and slew or walk where they "
      "are "
      "better; others may be better still. `tuning.csv` has everything that it looked at. Numbers on this "
      "page "
      "are rounded to the nearest; what is proved of the design, [certificate.md](certificate.md) says.\n",
      trade_off.words,
      trade_off.is_simulated ? "It is simulated and proves nothing. "
      : trade_off.is_estimated
          ? "During the search it is estimated from sampled points, which proves nothing. "
          : "It is certified for each design. ");
  return text;
}

std::string tuning_table(const TradeOff& trade_off) {
  std::string text = "role,q1,q2,r,epsilon,response_samples,objective,all_that_is_required\n";
  for (const TriedDesign& design : trade_off.designs) {
    text += role_words(design.role);
    for (const auto& [key, value] : design.values) {
      text += "," + value;
    }
    text += fmt::format(",{},{},{}\n", response_words(design),
                        design.value ? fmt::format("{:.9g}", *design.value) : "", design.meets);
  }
  return text;
}

std::string write_tuning_files(const certificates::TuningResult& result, const std::string& tuned_name,
                               const std::filesystem::path& directory) {
  std::string missing;
  std::optional<Figure> figure;
  try {
    figure = draw_trade_off(result.trade_off.value());
  } catch (const FigureError& error) {
    missing = error.what();
  }
  certificates::OutputFiles files;
  if (figure) {
    files.stage(directory / "figures" / figure->file, figure->svg);
  }
  files.stage(directory / "tuning.md", tuning_document(result, tuned_name, figure ? figure->caption : ""));
  files.stage(directory / "tuning.csv", tuning_table(result.trade_off.value()));
  files.commit();
  return missing;
}

}  // namespace veritrack::reports
