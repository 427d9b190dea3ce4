"""The lowest SNR as what a sweep records: takes long, for the nightly run."""

import veritrack
from conftest import ROOT


def test_a_sweep_records_the_lowest_snr(tmp_path):
    swept = veritrack.sweep(ROOT / "docs/example/sweep/base-17-db.toml", {"assume.frequency_walk": [0]},
                            folder=tmp_path, jobs=1, extent="everything", record=["ekf/lowest-snr/lowest_snr"])
    assert swept.counts == {"proved": 1}
    lowest, = swept.columns()["ekf/lowest-snr/lowest_snr"]
    # What keeps lock at 17 dB does so at a lower SNR; the tracker is no better than 0 dB.
    assert 0 < lowest <= 17
