// What is computed once for a cell of a tube and used again for every radius and noise.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "analysis/model/tube_step.hpp"

namespace veritrack::model {

/// Keeps what depends on the place in a cell only, for one tracker and one tube, and one kind of value, up to
/// a number of cells: the first ones that are asked for. A search verifies the same cells again and again,
/// for other radii, noises and levels. What is kept is what would be computed again, so that results do not
/// depend on it. Used by several threads.
class PlaceStore {
 public:
  /// Model and tube must not change as long as this exists.
  PlaceStore(const TrackerModel& model, const Tube& tube, std::size_t most)
      : model_(&model), tube_(&tube), most_(most) {}

  /// What is known of a cell, by `make()` unless it is kept. `variant`: a number on which that depends, too,
  /// the slew, or which parts there are. Throws std::logic_error for another model or tube.
  template <typename Value, typename Make>
  [[nodiscard]] std::shared_ptr<const Value> at(const TrackerModel& model, const Tube& tube,
                                                const TubeCell& cell, double variant, const Make& make) {
    if (&model != model_ || &tube != tube_) {
      throw std::logic_error("what is kept of one tube is asked for another one");
    }
    const Key key{cell.turn, cell.half_turn, cell.z, cell.half_z, variant};
    {
      const std::scoped_lock lock(mutex_);
      const auto found = kept_.find(key);
      if (found != kept_.end()) {
        return std::static_pointer_cast<const Value>(found->second);
      }
    }
    const auto value = std::make_shared<const Value>(make());
    const std::scoped_lock lock(mutex_);
    if (kept_.size() < most_) {
      kept_.emplace(key, value);
    }
    return value;
  }

 private:
  using Key = std::array<double, 5>;

  const TrackerModel* model_;
  const Tube* tube_;
  std::size_t most_;
  std::mutex mutex_;
  std::map<Key, std::shared_ptr<const void>> kept_;
};

/// The same without a store: computed.
template <typename Value, typename Make>
[[nodiscard]] std::shared_ptr<const Value> kept_at(PlaceStore* store, const TrackerModel& model,
                                                   const Tube& tube, const TubeCell& cell, double variant,
                                                   const Make& make) {
  return store != nullptr ? store->at<Value>(model, tube, cell, variant, make)
                          : std::make_shared<const Value>(make());
}

}  // namespace veritrack::model
