#include "checker/registry.hpp"

#include <algorithm>
#include <array>

#include "checker/dft_block/dft_block_certificate.hpp"
#include "checker/kkl_observer/kkl_certificate.hpp"
#include "checker/model/model_certificate.hpp"
#include "checker/quadrature/quadrature_certificate.hpp"
#include "checker/regulator/regulator_certificate.hpp"
#include "checker/single_channel/single_channel_certificate.hpp"

namespace veritrack::checker {

void verify_tracker(const Tree& certificate, bool all_boxes, Verification& result) {
  static const std::array kinds{quadrature_tracker(), single_channel_tracker(),
                                kkl_observer(),       model_tracker(),
                                regulator(),          dft_block_tracker()};
  const std::string& name = certificate.at("design").at("tracker").text();
  const auto* const kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const TrackerKind& known) { return known.name == name; });
  if (kind == kinds.end()) {
    result.parts.push_back({"tracker " + name, {kUnknown}});
    return;
  }
  kind->verify(certificate, all_boxes, result);
}

}  // namespace veritrack::checker
