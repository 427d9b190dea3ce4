// Boxes that cover the unit disc.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace veritrack::checker {

using DiscPoint = std::array<double, 2>;

/// A box of (x, y) and of frequencies, rad/sample.
struct DiscCell {
  DiscPoint low, high;
  double from, to;

  /// No point of the box is in the unit disc, for certain.
  [[nodiscard]] bool is_outside() const;
  /// Corners of a polygon that contains the part of the box in the unit disc.
  [[nodiscard]] std::vector<DiscPoint> corners() const;
  /// The two halves: 0 and 1 along x and y, 2 along the frequencies.
  [[nodiscard]] std::array<DiscCell, 2> halves(std::size_t side) const;
};

/// The places where the cells of a level were cut: a good first division for the level below it, and for
/// other frequencies. It only decides which cells are examined, and the parts of a cell cover it: no division
/// proves anything.
class DiscDivision {
 public:
  static constexpr std::size_t kWhole = 0;  ///< the node of the cell that holds all

  DiscDivision() : nodes_(1) {}

  [[nodiscard]] bool is_cut(std::size_t node) const { return nodes_[node].first != 0; }
  /// A cut cell whose parts are not cut, and which failed at a level well above this one: here it may
  /// succeed.
  [[nodiscard]] bool may_hold(std::size_t node, double level) const;
  void cut(std::size_t node, std::size_t side, double level);
  void undo_cut(std::size_t node) { nodes_[node].first = 0; }
  /// The side and the parts of a cut node.
  [[nodiscard]] std::size_t side(std::size_t node) const { return nodes_[node].side; }
  [[nodiscard]] std::size_t part(std::size_t node, std::size_t which) const {
    return nodes_[node].first + which;
  }

 private:
  struct Node {
    std::size_t first = 0;  ///< of two parts; 0 when it is not cut
    std::size_t side = 0;
    double level = 0.0;  ///< at which it failed
  };
  std::vector<Node> nodes_;
};

}  // namespace veritrack::checker
