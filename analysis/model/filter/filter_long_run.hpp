// The search for a tube of a filter in the long run, inside another one: see filter_proposal.hpp.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "analysis/model/filter/filter_worth.hpp"

namespace veritrack::model::detail {

/// The parameters with which the tube is smallest. The bounds of the covariance are those for estimates in
/// the other tube, so that they do not depend on the shape.
class LongRunSearch {
 public:
  LongRunSearch(const TrackedTone& tone, const CurveFit& curve, const FilterCoordinates& coordinates,
                const Tube& around, double radius, int evaluations);

  [[nodiscard]] FilterWorth worth_at(const FilterParameters& parameters, int samples,
                                     double enough = 0.0) const;
  /// Starts from parameters of the other tube, and those that were found at neighbouring frequencies, if any;
  /// empty when there is no tube.
  [[nodiscard]] std::optional<VectorXd> run(const VectorXd& of_around, const VectorXd& nearby) const;

 private:
  using WorthOf = std::function<FilterWorth(const FilterParameters&)>;

  static constexpr std::array<double, 3> kPlaces{-1.0, 0.0, 1.0};
  [[nodiscard]] FilterWorth worth_there(std::size_t place, const FilterParameters& parameters, double share,
                                        int samples, double enough) const;
  [[nodiscard]] Surroundings surroundings(std::size_t place) const {
    return {around_, radius_, kPlaces.at(place)};
  }
  /// The smallest scale at which the growth is admissible; infinity when there is none nearby.
  [[nodiscard]] double least_scale(const VectorXd& x, const WorthOf& worth_of) const;
  [[nodiscard]] ScoredPoint score(const VectorXd& x) const;
  void improve(ScoredPoint& best, double step) const;

  const TrackedTone* tone_;
  std::array<NodeCurve, kPlaces.size()> nodes_;
  FilterCoordinates coordinates_;
  const Tube* around_;
  double radius_;
  int evaluations_;                  ///< of each round
  std::vector<OrbitPoints> points_;  ///< of the nodes
};

}  // namespace veritrack::model::detail
