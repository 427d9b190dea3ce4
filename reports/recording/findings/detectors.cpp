#include "reports/recording/findings/detectors.hpp"

namespace veritrack::reports {

std::vector<std::unique_ptr<Detector>> all_detectors(const certificates::SignalAssumptions& assume,
                                                     int channels) {
  std::vector<std::unique_ptr<Detector>> all;
  all.push_back(dropout_detector(channels));
  all.push_back(clipping_detector(channels));
  all.push_back(sweep_detector(assume, channels));
  all.push_back(quantisation_detector(assume, channels));
  all.push_back(offset_detector(channels));
  all.push_back(harmonics_detector());
  all.push_back(hum_detector());
  all.push_back(amplitude_detector(assume));
  return all;
}

}  // namespace veritrack::reports
