"""What the tests of the package share."""

import pathlib

import pytest

import veritrack

ROOT = pathlib.Path(__file__).resolve().parents[2]

TEXT = """\
name    = "a design"
tracker = "quadrature-ekf"

[design]
q1 = 0.0023
q2 = 0.0023
r = 0.05
epsilon = 0.0

[assume]
amplitude = 1.0
frequency = [0.05, 3.0]
noise = 0.001
slew = 0.0
initial_frequency_error = 0.005
initial_phase_error = 0.005
initial_amplitude_error = 0.005

[require]
frequency_error_below = 0.05

[simulate]
samples = 50
"""


@pytest.fixture(scope="session")
def design():
    return veritrack.Design.from_toml(TEXT, "mine.toml")


@pytest.fixture(scope="session")
def certificate(design):
    return veritrack.certify(design)
