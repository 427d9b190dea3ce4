// Quantities that are computed once for a cell of a tube and used again for every radius and noise.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <typeindex>
#include <utility>

#include "analysis/model/step/tube_step.hpp"

namespace veritrack::model {

/// Keeps the quantities that depend on the place in a cell only, for one tracker and one tube, up to a number
/// of cells: the first ones that are requested. A search verifies the same cells repeatedly, for other radii,
/// noises and levels. Kept values equal those that would be computed again, so that results do not depend on
/// the store. Used by several threads.
class PlaceStore {
 public:
  /// The model must not change as long as this exists. `most`: cells.
  PlaceStore(const TrackerModel& model, Tube tube, std::size_t most)
      : model_(&model), tube_(std::move(tube)), most_(most) {}

  /// The quantities of a cell, by `make()` unless they are kept. `variant`: a number on which they also
  /// depend, the slew or the parts to compute; they depend on nothing else. For another model, for a tube
  /// that is not equal to the one here, and for numbers that are NaN, nothing is kept and nothing is found.
  template <typename Value, typename Make>
  [[nodiscard]] std::shared_ptr<const Value> at(const TrackerModel& model, const Tube& tube,
                                                const TubeCell& cell, double variant, const Make& make) {
    const Numbers numbers{cell.turn, cell.half_turn, cell.z, cell.half_z, variant};
    bool is_known = &model == model_ && tube == tube_;
    for (const double number : numbers) {
      is_known = is_known && !std::isnan(number);  // which has no place in an order
    }
    if (!is_known) {
      return std::make_shared<const Value>(make());
    }
    const Key key{std::type_index(typeid(Value)), numbers};
    {
      const std::scoped_lock lock(mutex_);
      const auto found = kept_.find(key);
      if (found != kept_.end()) {
        return std::static_pointer_cast<const Value>(found->second);
      }
    }
    std::shared_ptr<const Value> value = std::make_shared<const Value>(make());
    const std::scoped_lock lock(mutex_);
    if (kept_.size() < most_) {
      kept_.emplace(key, value);
    }
    return value;
  }

 private:
  using Numbers = std::array<double, 5>;
  using Key = std::pair<std::type_index, Numbers>;

  const TrackerModel* model_;
  const Tube tube_;
  std::size_t most_;
  std::mutex mutex_;
  std::map<Key, std::shared_ptr<const void>> kept_;
};

/// The number of places of a tube that take about `bytes`.
[[nodiscard]] inline std::size_t places_in(const Tube& tube, double bytes) {
  // The tube at both phases, and the matrices of a filter (filter_step.cpp).
  constexpr double kBytesOfModel = 300.0;
  constexpr double kMatrices = 8.0;
  const auto states = static_cast<double>(tube.curve.size());
  const std::size_t here =
      tube.curve.size() + tube.shape.size() + tube.covariance_low.size() + tube.covariance_high.size();
  const double of_filter = tube.bounds_covariance() ? kMatrices * states * states : 0.0;
  return static_cast<std::size_t>(bytes /
                                  (kBytesOfModel * (2.0 * static_cast<double>(here) + of_filter + 8.0)));
}

/// The same without a store: computed.
template <typename Value, typename Make>
[[nodiscard]] std::shared_ptr<const Value> kept_at(PlaceStore* store, const TrackerModel& model,
                                                   const Tube& tube, const TubeCell& cell, double variant,
                                                   const Make& make) {
  return store != nullptr ? store->at<Value>(model, tube, cell, variant, make)
                          : std::make_shared<const Value>(make());
}

}  // namespace veritrack::model
