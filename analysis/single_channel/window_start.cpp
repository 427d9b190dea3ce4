#include <cmath>
#include <limits>

#include "analysis/single_channel/window_grid.hpp"

namespace veritrack::single_channel {

StartProposal propose_start(const WindowRequest& request, const WindowClaim& claim, const StartBox& box) {
  const rigor::UpwardRounding upward;
  const detail::PhaseGrid grid(request);
  detail::GridLevels found{};
  detail::grid_functions().levels(grid.task(claim.assumption, static_cast<int>(claim.shares.size())),
                                  box.signal, box.frequency, found);
  StartProposal best{std::numeric_limits<double>::infinity(), 0.5};
  for (int i = 0; i < detail::kParts; ++i) {
    if (found.levels[i] < best.level) {
      best = {found.levels[i], 0.1 * (i + 1)};
    }
  }
  return best;
}

}  // namespace veritrack::single_channel
