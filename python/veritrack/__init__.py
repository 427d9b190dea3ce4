"""Veritrack: machine-checked certificates for frequency trackers.

    design = veritrack.Design.from_file("my-design.toml")
    certificate = veritrack.certify(design)
    certificate.verdict, certificate.bounds["frequency_error_bound"]
    certificate.verify()                                     # by an independent program
    veritrack.trackers.QuadratureEkf.from_design(design, frequency=0.5).run(samples)
    veritrack.sweep(design, {"design.q1": [0.001, 0.002]}).counts      # many designs

docs/python.md goes through it, docs/sweeps.md through sweeps.
"""

from . import sweep, trackers
from ._engine import identity, version
from .blocks import DftBlockEkf
from .certificate import Certificate, Claim, Figure, certify
from .checking import Checked, check
from .design import Design
from .errors import (ArithmeticNotTrusted, EngineError, InputError, MalformedCertificate, TimeLimit,
                     VeritrackError)
from .interval import Bound, Interval
from .sine_filters import MedianFilter, SineEkf
from .trackers import (KklObserver, QuadratureBatch, QuadratureEkf, QuadratureNotch, RealNotch,
                       SingleChannelEkf)
from .verification import Verification, verify

__all__ = [
    "ArithmeticNotTrusted", "Bound", "Certificate", "Checked", "Claim", "Design", "DftBlockEkf", "EngineError",
    "Figure", "InputError", "Interval", "KklObserver", "MalformedCertificate", "MedianFilter",
    "QuadratureBatch", "QuadratureEkf", "QuadratureNotch", "RealNotch", "SineEkf", "SingleChannelEkf",
    "TimeLimit", "Verification", "VeritrackError", "certify", "check", "identity", "sweep", "trackers",
    "verify", "version",
]
