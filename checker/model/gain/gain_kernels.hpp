// How much of an input of earlier samples there is in a form of a network (docs/gain-proof.md, section 4).
#pragma once

#include <optional>
#include <vector>

#include "checker/model/gain/gain_network.hpp"
#include "checker/model/gain/wide_number.hpp"

namespace veritrack::checker {

class GainKernels {
 public:
  /// `blocks` divides `horizon`.
  GainKernels(const GainNetwork& network, std::size_t horizon, std::size_t blocks);

  /// Whether the sums over all samples are bounded. Nothing else is known where they are not.
  [[nodiscard]] bool is_certain() const { return is_certain_; }
  [[nodiscard]] std::size_t blocks() const { return blocks_; }
  [[nodiscard]] std::size_t block_length() const { return horizon_ / blocks_; }
  /// The sums over the lags of each block, but for the tail.
  [[nodiscard]] const std::vector<double>& by_block(std::size_t form, std::size_t input) const {
    return kernels_[form][input];
  }
  /// epsilon: for all lags together.
  [[nodiscard]] double tail(std::size_t form, std::size_t input) const { return tails_[form][input]; }
  /// |d|.
  [[nodiscard]] double direct(std::size_t form, std::size_t input) const { return direct_[form][input]; }
  /// For all lags, and directly.
  [[nodiscard]] double total(std::size_t form, std::size_t input) const;
  /// T of the theorem by form and block, the last one without end; nothing where it is not certain.
  [[nodiscard]] std::optional<Table> starts(const std::vector<Ball>& start) const;

 private:
  /// False where a number is not finite.
  bool read(const GainNetwork& network);
  void sum_kernels();
  [[nodiscard]] bool close_tails();
  /// |row| M bound.
  [[nodiscard]] double through_defect(const WideRow& row, const std::vector<double>& bound) const;

  std::size_t forms_, horizon_, blocks_;
  std::vector<WideRow> columns_;              ///< of A
  std::vector<std::vector<WideRow>> inputs_;  ///< the two columns of each input
  std::vector<WideRow> rows_;                 ///< of the forms, then the unit rows
  std::vector<Table> kernels_;                ///< by row, input and block
  Table defect_;                              ///< M
  Table tails_, direct_;                      ///< by form and input
  bool is_certain_ = false;
};

}  // namespace veritrack::checker
