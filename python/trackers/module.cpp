// veritrack._trackers: the trackers' own headers on arrays. veritrack/trackers.py wraps it for people.
#include "python/trackers/recordings.hpp"

PYBIND11_MODULE(_trackers, module) {  // NOLINT: pybind11's macro
  module.doc() = "Batches of trackers on arrays of doubles; see veritrack.trackers.";
  veritrack::python::bind_block_trackers(module);
  veritrack::python::bind_extended_kalman_filters(module);
  veritrack::python::bind_kkl_observers(module);
  veritrack::python::bind_notches(module);
  veritrack::python::bind_zarchan_filters(module);
}
