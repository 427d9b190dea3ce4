// The ledger on one page: for each publication the claims that stand, those that fall, and what is proved in
// their place.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "papers/ledger/ledger.hpp"

namespace veritrack::reports::ledger {

/// A publication, or a part of one, in a few words. The words are ours; the rows behind them are named, and a
/// test compares their verdicts with the words.
struct SummaryLine {
  theorems::Paper paper;
  std::string_view publication;
  std::string_view stands;
  std::string_view falls;
  std::string_view repair;
  std::vector<std::string_view> proved;   ///< claims that stand
  std::vector<std::string_view> refuted;  ///< claims that fall
};

/// Every publication at least once.
[[nodiscard]] std::span<const SummaryLine> summary_lines();

/// The page: a sentence with the numbers, and the lines as a table.
[[nodiscard]] std::string summary(const std::vector<Row>& rows);

/// How many claims of what kind have which verdict, in words.
[[nodiscard]] std::string count_sentences(const std::vector<Row>& rows);

/// The same by publication and role, as a table.
[[nodiscard]] std::string counts_table(const std::vector<Row>& rows);

}  // namespace veritrack::reports::ledger
