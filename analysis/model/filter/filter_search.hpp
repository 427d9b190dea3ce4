// The search for the parameters with which bounds and shape of a filter are carried along: see
// filter_proposal.hpp.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/model/filter/filter_worth.hpp"
#include "analysis/model/shape/proposed_tube.hpp"

namespace veritrack::model::detail {

/// Found at the middle of the cell, and then scaled so that they also work at its ends.
class FilterSearch {
 public:
  FilterSearch(const TrackedTone& tone, const CurveFit& curve, const TubeSettings& settings, double rate);

  [[nodiscard]] const FilterCoordinates& coordinates() const { return coordinates_; }
  /// At the middle and both ends.
  [[nodiscard]] FilterWorth worth_at(const FilterParameters& parameters, int samples,
                                     double enough = 0.0) const;
  /// The best point found, scaled for the whole cell.
  [[nodiscard]] std::optional<VectorXd> run(const VectorXd& nearby);

 private:
  using WorthOf = std::function<FilterWorth(const FilterParameters&)>;

  void follow_orbits();
  /// The point with a larger or smaller tube.
  [[nodiscard]] VectorXd with_size(VectorXd x, double logarithm) const;
  /// The point with a larger or smaller scale: of the tube, or of the noise.
  [[nodiscard]] VectorXd scaled(VectorXd x, double logarithm) const;
  /// The largest scale at which the growth is admissible; -infinity when there is none nearby.
  [[nodiscard]] double largest_scale(const VectorXd& x, const WorthOf& worth_of) const;
  [[nodiscard]] ScoredPoint score(const VectorXd& x) const;
  [[nodiscard]] std::vector<ScoredPoint> scores_of(const std::vector<VectorXd>& points) const;
  /// Starts for the reach.
  [[nodiscard]] std::vector<ScoredPoint> first_starts() const;
  /// For a given disturbance: from tubes without any, made smaller.
  [[nodiscard]] std::vector<ScoredPoint> starts_without_disturbance() const;
  void improve(ScoredPoint& best, double step) const;
  /// Searches for the largest disturbance, repeatedly.
  void improve_further(ScoredPoint& best);
  /// At the ends of the cell a smaller tube may be needed, not only less noise.
  [[nodiscard]] ScoredPoint for_whole_cell(const VectorXd& point) const;

  const TrackedTone* tone_;
  std::array<NodeCurve, 3> nodes_;
  std::array<Eigen::MatrixXcd, 3> slopes_;
  std::shared_ptr<const std::vector<OrbitPoints>> points_;  ///< of the nodes; none until the search begins
  FilterCoordinates coordinates_;
  double largest_reach_ = 0.0;
  int evaluations_ = 0;  ///< of each round
  int halvings_ = 6;     ///< to find a scale
  search::Deadline deadline_;
};

}  // namespace veritrack::model::detail
