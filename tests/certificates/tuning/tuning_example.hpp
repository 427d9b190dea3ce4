// A design to tune, for the tests of this folder.
#pragma once

#include <string>

#include "certificates/design/design_reader.hpp"
#include "certificates/quadrature/quadrature_design.hpp"

namespace veritrack::certificates::testing {

inline const std::string kTunedText =
    "name = \"a design\"\ntracker = \"quadrature-ekf\"\n[design]\nq1 = 0.0023\nq2 = 0.0023\nr = 0.05\n"
    "epsilon = 0\n[assume]\nfrequency = [0.5, 1.5]\nnoise = 0.02\nslew = 1e-4\ninitial_frequency_error = "
    "0.005\ninitial_phase_error = 0.005\ninitial_amplitude_error = 0.005\n";

inline const std::string kTunedTextAt20Decibels =
    "name = \"a design\"\ntracker = \"quadrature-ekf\"\n[design]\nq1 = 1e-4\nq2 = 1e-4\nr = 0.005\n"
    "epsilon = 0\n[assume]\nfrequency = [0.5, 1.5]\nnoise = { snr_db = 20 }\nfrequency_walk = 0.001\n"
    "samples = 1e6\ninitial_frequency_error = 0.005\ninitial_phase_error = 0.005\ninitial_amplitude_error = "
    "0.005\n";

}  // namespace veritrack::certificates::testing
